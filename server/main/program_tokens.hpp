// The tokens of the programs that this gateway starts (docs/engines.md#programs).
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gateway/access/secrets.hpp"
#include "gateway/access/tokens.hpp"

namespace rois {

// With its token, a program joins as its own sub engine. Used on the thread of the programs.
class ProgramTokens {
public:
    explicit ProgramTokens(std::size_t most_wrong) : tokens_{most_wrong} {}

    // Thread-safe.
    Tokens& all() { return tokens_; }

    // Makes a token. The earlier one of the program is not valid any more.
    std::string make(std::string const& program) {
        auto token = fresh_token();
        auto holder = std::make_shared<Principal>();
        std::vector<std::string> const own{program + ".*"};
        holder->role = Role::engine;
        holder->rights = std::make_shared<Rights const>("program " + program, own, own);
        holder->hash = sha256(token);
        if (auto const earlier = std::exchange(given_[program], holder->rights)) earlier->withdraw();
        tokens_.add(std::move(holder));
        return token;
    }

private:
    Tokens tokens_;
    std::map<std::string, std::shared_ptr<Rights const>> given_;
};

}  // namespace rois
