// The file of tokens (key `tokens`; docs/trust.md): JSON. It holds the hashes of the tokens, not the tokens.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "gateway/access/tokens.hpp"
#include "types/instant.hpp"

namespace rois {

struct TokenEntry {
    std::string name;
    Role role = Role::nobody;
    std::vector<std::string> components{"*"};  // patterns of the refs that it may see
    std::vector<std::string> commands{"*"};    // and of those among them that it may bind and command
    std::optional<Utc> expires;                // nothing: never
    Sha256 sha256{};
};

// All functions throw BadSettings, with the file and the reason.
std::vector<TokenEntry> read_tokens(std::string const& file);
// Makes a token, adds its entry, and returns it. Makes the file if it does not exist.
std::string add_token(std::string const& file, TokenEntry);
void revoke_token(std::string const& file, std::string const& name);

// Lines for a terminal: name, role, components, commands, and when it expires.
std::string table_of(std::vector<TokenEntry> const&, Utc now);

// Returns whether a token may have this name: letters, digits, '_', '-' and '.', 64 at most.
bool is_token_name(std::string_view);
// Whether the text can be a pattern of refs, such as "robot1.*" or "robot[23].*".
bool is_pattern(std::string_view);
constexpr std::string_view expected_pattern =
    "expected patterns of refs such as 'robot1.*' or 'robot[23].*', of 1 to 256 characters, with a ']' for each '[', "
    "without line ends";

// Returns the token that a file holds, without white space around it: one to send. Throws BadSettings.
std::string token_in(std::string const& file);

// When a token expires: "30d", "12h" or "45min" from now, a day in UTC (at its end), or a time such as "2027-01-31T18:00:00Z".
// Returns nothing for another text, and for a time after the year 2261, which the clock cannot show.
std::optional<Utc> read_expiry(std::string_view, Utc now);

// Reads the file again when it has changed, on a thread of its own. If it cannot be read, logs why and changes nothing.
class TokensFile {
public:
    // Reads the file; throws BadSettings if that fails. `tokens` must outlive it.
    TokensFile(std::string file, Tokens& tokens);

    // Throws BadSettings if the file is not valid. Thread-safe, as `look`.
    std::vector<std::shared_ptr<Principal>> read() const;
    // Reads the file again if it has changed since the last time.
    void look();

private:
    void use(std::vector<std::shared_ptr<Principal>>);
    void watch(std::stop_token const&);

    std::string const file_;
    Tokens& tokens_;
    std::mutex mutex_;       // guards the next two, and keeps an older content from replacing a newer one
    std::string version_;    // of the file that was read last
    std::string complaint_;  // the last one, about the present file
    std::jthread thread_;
};

}  // namespace rois
