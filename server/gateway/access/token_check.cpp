#include "gateway/access/token_check.hpp"

#include <openssl/crypto.h>

#include <string_view>
#include <utility>
#include <variant>

namespace rois {

namespace {

// Takes the same time wherever the two differ.
bool is_same_secret(std::string_view a, std::string_view b) {
    return a.size() == b.size() && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace

std::optional<Tokens::Refused> TokenCheck::check(Tokens& tokens, std::optional<std::string> const& token, Client& client) {
    if (!valid_.empty() && token && is_same_secret(*token, valid_) && !client.principal->is_over()) return {};
    forget(client);
    if (!token) return Tokens::Refused::wrong;
    auto found = tokens.holder(*token, client.address, {std::chrono::steady_clock::now(), std::chrono::system_clock::now()});
    if (auto const* refused = std::get_if<Tokens::Refused>(&found)) return *refused;
    client.principal = std::get<Tokens::Holder>(std::move(found));
    valid_ = *token;
    return {};
}

void TokenCheck::forget(Client& client) {
    client.principal = Principal::nobody();
    valid_.clear();
}

}  // namespace rois
