#include "server/token_file.hpp"

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace rois::test {

TokenFile::TokenFile() {
    std::string folder = std::filesystem::temp_directory_path() / "rois-tokens-XXXXXX";
    if (::mkdtemp(folder.data()) == nullptr) throw std::runtime_error{"no folder for tokens"};
    name_ = folder + "/tokens.json";
}

TokenFile::~TokenFile() { std::filesystem::remove_all(folder()); }

kit::Ended TokenFile::run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "token");
    arguments.insert(arguments.end(), {"--tokens", name_});
    return kit::run_gateway(arguments);
}

std::string TokenFile::add(std::string const& name, std::string const& role, std::vector<std::string> const& more) const {
    std::vector<std::string> arguments{"add", name, "--role", role};
    arguments.insert(arguments.end(), more.begin(), more.end());
    auto const ended = run(arguments);
    if (ended.exit_code != 0) throw std::runtime_error{ended.error};
    return ended.out.substr(0, ended.out.find('\n'));
}

std::vector<std::string> TokenFile::of_gateway(std::vector<std::string> const& more) const {
    std::vector<std::string> all{"--tokens", name_};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

kit::Address with_token(std::string const& token, kit::GatewayProcess const& gateway) {
    auto address = gateway.address();
    address.token = token;
    return address;
}

}  // namespace rois::test
