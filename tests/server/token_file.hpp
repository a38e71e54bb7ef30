// A file of tokens, as administrators make it.
#pragma once

#include <string>
#include <vector>

#include "kit/gateway_process.hpp"

namespace rois::test {

// In a folder of its own, which the destructor removes.
class TokenFile {
public:
    TokenFile();
    ~TokenFile();
    TokenFile(TokenFile const&) = delete;
    TokenFile& operator=(TokenFile const&) = delete;

    std::string const& name() const { return name_; }
    std::string folder() const { return name_.substr(0, name_.rfind('/')); }

    // Runs `rois-gateway token ARGUMENTS... --tokens FILE`.
    kit::Ended run(std::vector<std::string> arguments) const;
    // Adds a token and returns it. Throws std::runtime_error if the program refuses.
    std::string add(std::string const& name, std::string const& role, std::vector<std::string> const& more = {}) const;

    // The arguments of a gateway with this file.
    std::vector<std::string> of_gateway(std::vector<std::string> const& more = {}) const;

private:
    std::string name_;
};

// The gateway's address for the holder of a token.
kit::Address with_token(std::string const& token, kit::GatewayProcess const&);

}  // namespace rois::test
