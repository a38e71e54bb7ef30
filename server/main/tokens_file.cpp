#include "main/tokens_file.hpp"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <functional>
#include <system_error>
#include <utility>

#include "main/configuration_file.hpp"
#include "main/json_file.hpp"
#include "main/settings.hpp"
#include "types/text/listing.hpp"
#include "types/text/text_encoding.hpp"
#include "types/text/texts.hpp"
#include "types/text/to_number.hpp"
#include "types/unique_descriptor.hpp"

namespace rois {

namespace {

using nlohmann::json;

constexpr std::size_t most_tokens = 1'000;
constexpr auto between_looks = std::chrono::milliseconds{250};

[[noreturn]] void fail(std::string const& what) { throw BadSettings{what + ": " + std::strerror(errno)}; }

// Whoever can write the file can give himself every right.
void check_mode(std::string const& file) {
    struct stat found {};
    if (::stat(file.c_str(), &found) != 0) fail("tokens: cannot read " + rois::quoted(file));
    if (!S_ISREG(found.st_mode)) throw BadSettings{"tokens: " + rois::quoted(file) + " is not a file"};
    if (found.st_uid != 0 && found.st_uid != ::geteuid())
        throw BadSettings{"tokens: " + rois::quoted(file) + " belongs to another user: expected one of root or of this process"};
    if ((found.st_mode & (S_IWGRP | S_IWOTH)) != 0)
        throw BadSettings{"tokens: others may write " + rois::quoted(file) + ": expected the mode 0600 (chmod 600)"};
}

std::string text_at(json const& entry, std::string_view key) {
    auto const found = entry.find(key);
    return found != entry.end() && found->is_string() ? found->get<std::string>() : std::string{};
}

bool is_pattern_text(json const& value) { return value.is_string() && is_pattern(value.get_ref<std::string const&>()); }

// Why the entry is not one, or an empty text. Sets `entry`.
std::string problem_of(json const& object, TokenEntry& entry) {
    static constexpr std::array<std::string_view, 6> known{"name", "role", "sha256", "components", "commands", "expires"};
    for (auto const& [key, value] : object.items())
        if (std::ranges::find(known, key) == known.end())
            return rois::quoted(key) + " is not a key of a token: expected one of " + listed(known);
    entry.name = text_at(object, "name");
    if (!is_token_name(entry.name)) return "name must be letters, digits, '_', '-' and '.', 64 at most";
    auto const role = read_role(text_at(object, "role"));
    if (!role) return "role must be one of " + names_of_roles();
    auto const hash = read_sha256(text_at(object, "sha256"));
    if (!hash) return "sha256 must be 64 hexadecimal digits";
    for (auto const& [key, patterns] : {std::pair{"components", &entry.components}, {"commands", &entry.commands}}) {
        auto const found = object.find(key);
        if (found == object.end()) continue;
        if (!found->is_array() || !std::ranges::all_of(*found, is_pattern_text))
            return std::string{key} + " must be a list of patterns: " + std::string{expected_pattern};
        *patterns = found->get<std::vector<std::string>>();
    }
    if (object.contains("expires")) {
        entry.expires = to_utc(text_at(object, "expires"));
        if (!entry.expires) return "expires must be a time such as 2027-01-31T18:00:00Z";
    }
    entry.role = *role;
    entry.sha256 = *hash;
    return {};
}

json object_of(TokenEntry const& entry) {
    json object{{"name", entry.name}, {"role", to_text(entry.role)}, {"sha256", to_text(entry.sha256)}};
    if (entry.components != TokenEntry{}.components) object["components"] = entry.components;
    if (entry.commands != TokenEntry{}.commands) object["commands"] = entry.commands;
    if (entry.expires) object["expires"] = to_text(*entry.expires);
    return object;
}

std::filesystem::path folder_of(std::string const& file) { return std::filesystem::absolute(file).parent_path(); }

// The file that a link stands for: a link is not replaced by a file that only it names.
std::string without_links(std::string const& file) {
    std::error_code ignored;
    auto const real = std::filesystem::weakly_canonical(file, ignored);
    return real.empty() ? file : real.string();
}

// Keeps other processes from changing the files of the folder with these functions.
UniqueDescriptor locked_folder(std::string const& file) {
    UniqueDescriptor folder{::open(folder_of(file).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
    if (folder.get() < 0 || ::flock(folder.get(), LOCK_EX) != 0) fail("tokens: cannot change " + rois::quoted(file));
    return folder;
}

// Replaces the file in one step: a reader finds the old or the new one, also after a power cut.
void replace(std::string const& file, std::vector<TokenEntry> const& entries, UniqueDescriptor const& folder) {
    json list = json::array();
    for (auto const& entry : entries) list.push_back(object_of(entry));
    auto const text = json{{"tokens", std::move(list)}}.dump(2) + "\n";
    auto temporary = file + ".XXXXXX";
    UniqueDescriptor const next{::mkostemp(temporary.data(), O_CLOEXEC)};  // with the mode 0600
    if (next.get() < 0) fail("tokens: cannot change " + rois::quoted(file));
    struct stat earlier {};
    if (::stat(file.c_str(), &earlier) == 0 && ::fchown(next.get(), earlier.st_uid, earlier.st_gid) != 0 && ::geteuid() == 0)
        spdlog::warn("tokens: {} belongs to root now", file);
    try {
        write_all(next, text);
        bool const done =
            ::fsync(next.get()) == 0 && ::rename(temporary.c_str(), file.c_str()) == 0 && ::fsync(folder.get()) == 0;
        if (!done) throw std::system_error{errno, std::system_category()};
    } catch (std::system_error const& error) {
        ::unlink(temporary.c_str());
        throw BadSettings{"tokens: cannot change " + rois::quoted(file) + ": " + error.code().message()};
    }
}

// Distinguishes the versions of a file.
std::string version_of(std::string const& file) {
    struct stat found {};
    if (::stat(file.c_str(), &found) != 0) return {};
    auto const number = [](auto each) { return std::to_string(each) + " "; };
    return number(found.st_dev) + number(found.st_ino) + number(found.st_size) + number(found.st_mtim.tv_sec) +
           number(found.st_mtim.tv_nsec) + number(found.st_ctim.tv_sec) + number(found.st_ctim.tv_nsec);
}

std::shared_ptr<Principal> principal_of(TokenEntry const& entry) {
    auto principal = std::make_shared<Principal>();
    principal->role = entry.role;
    principal->rights = std::make_shared<Rights const>(entry.name, entry.components,
                                                       entry.role == Role::observer ? std::vector<std::string>{} : entry.commands,
                                                       to_text(sha256(object_of(entry).dump())));
    principal->expires = entry.expires;
    principal->hash = entry.sha256;
    return principal;
}

}  // namespace

std::vector<TokenEntry> read_tokens(std::string const& file) {
    check_mode(file);
    auto const text = text_of_file(file);
    auto const object = parse_json(file, text);
    auto const list = object.find("tokens");
    bool const is_list = object.size() == 1 && list != object.end() && list->is_array() &&
                         std::ranges::all_of(*list, [](json const& each) { return each.is_object(); });
    if (!is_list) throw BadSettings{file + ":1:1: expected only \"tokens\": [ ... ], a list of tokens"};
    if (list->size() > most_tokens) throw BadSettings{file + ": expected at most " + std::to_string(most_tokens) + " tokens"};
    auto places = objects_in(text);
    std::erase_if(places, [](ObjectInText const& each) { return each.depth != 2; });
    std::vector<TokenEntry> entries;
    for (auto const& each : *list) {
        auto const& place = places[entries.size()];
        auto const where = file + ":" + place_of(text, place.begin) + ": ";
        if (auto const* twice = place.repeated())
            throw BadSettings{file + ":" + place_of(text, twice->at) + ": " + rois::quoted(twice->name) + " is given twice"};
        TokenEntry entry;
        if (auto const problem = problem_of(each, entry); !problem.empty()) throw BadSettings{where + problem};
        if (std::ranges::find(entries, entry.name, &TokenEntry::name) != entries.end())
            throw BadSettings{where + "there are two tokens with the name " + rois::quoted(entry.name)};
        if (std::ranges::find(entries, entry.sha256, &TokenEntry::sha256) != entries.end())
            throw BadSettings{where + "there are two entries for one token: revoking one would leave it valid"};
        entries.push_back(std::move(entry));
    }
    return entries;
}

std::string add_token(std::string const& name_of_file, TokenEntry entry) {
    auto const file = without_links(name_of_file);
    auto const folder = locked_folder(file);
    auto entries = std::filesystem::exists(file) ? read_tokens(file) : std::vector<TokenEntry>{};
    if (std::ranges::find(entries, entry.name, &TokenEntry::name) != entries.end())
        throw BadSettings{"token add: there is a token with the name " + rois::quoted(entry.name) +
                          " already; revoke it first, or choose another name"};
    if (entries.size() >= most_tokens)
        throw BadSettings{"token add: there are " + std::to_string(most_tokens) + " tokens already: revoke one"};
    auto token = fresh_token();
    entry.sha256 = sha256(token);
    entries.push_back(std::move(entry));
    replace(file, entries, folder);
    return token;
}

void revoke_token(std::string const& name_of_file, std::string const& name) {
    auto const file = without_links(name_of_file);
    auto const folder = locked_folder(file);
    auto entries = read_tokens(file);
    if (std::erase_if(entries, [&](TokenEntry const& each) { return each.name == name; }) == 0)
        throw BadSettings{"token revoke: there is no token with the name " + rois::quoted(name) + " in " + rois::quoted(file)};
    replace(file, entries, folder);
}

std::string table_of(std::vector<TokenEntry> const& entries, Utc now) {
    using Row = std::array<std::string, 5>;
    std::vector<Row> rows{{"NAME", "ROLE", "COMPONENTS", "COMMANDS", "EXPIRES"}};
    for (auto const& entry : entries) {
        auto const expires = !entry.expires ? "never" : to_text(*entry.expires) + (*entry.expires <= now ? " (expired)" : "");
        rows.push_back({entry.name, std::string{to_text(entry.role)},
                        entry.components.empty() ? "none" : listed(entry.components),
                        entry.role == Role::observer || entry.commands.empty() ? "none" : listed(entry.commands), expires});
    }
    std::array<std::size_t, 5> widths{};
    for (auto const& row : rows)
        for (std::size_t column = 0; column < row.size(); ++column) widths[column] = std::max(widths[column], row[column].size());
    std::string table;
    for (auto const& row : rows) {
        std::string line;
        for (std::size_t column = 0; column < row.size(); ++column)
            line += row[column] + std::string(column + 1 < row.size() ? widths[column] + 2 - row[column].size() : 0, ' ');
        table += line + "\n";
    }
    return table;
}

bool is_pattern(std::string_view text) {
    constexpr std::size_t longest = 256;
    auto const bracket = text.rfind('[');
    bool const is_closed = bracket == std::string_view::npos || text.find(']', bracket + 2) != std::string_view::npos;
    bool const has_control = std::ranges::any_of(text, [](unsigned char c) { return c < ' ' || c == 0x7F; });
    return !text.empty() && text.size() <= longest && is_closed && !has_control && is_utf8(text);
}

bool is_token_name(std::string_view name) {
    auto const fits = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
    };
    return !name.empty() && name.size() <= 64 && std::ranges::all_of(name, fits);
}

std::string token_in(std::string const& file) {
    auto const token = std::string{trimmed(text_of_file(file))};
    auto const fits = [](unsigned char c) { return c > ' ' && c < 0x7F; };
    if (!token.empty() && token.size() <= 512 && std::ranges::all_of(token, fits)) return token;
    throw BadSettings{file + ": expected a token: one word of at most 512 characters"};
}

std::optional<Utc> read_expiry(std::string_view text, Utc now) {
    static constexpr std::array<std::pair<std::string_view, std::chrono::minutes>, 3> units{
        {{"min", std::chrono::minutes{1}}, {"h", std::chrono::hours{1}}, {"d", std::chrono::days{1}}}};
    constexpr unsigned most = 100'000;
    for (auto const& [unit, length] : units) {
        if (!text.ends_with(unit)) continue;
        auto const count = to_number<unsigned>(text.substr(0, text.size() - unit.size()));
        if (!count || *count == 0 || *count > most) return {};
        return now + *count * length;
    }
    auto const period = to_period(text);
    return period && period->end < Utc::max() ? std::optional{period->end} : std::nullopt;
}

TokensFile::TokensFile(std::string file, Tokens& tokens) : file_{std::move(file)}, tokens_{tokens} {
    version_ = version_of(file_);
    use(read());
    thread_ = std::jthread{[this](std::stop_token const& stop) { watch(stop); }};
}

std::vector<std::shared_ptr<Principal>> TokensFile::read() const {
    std::vector<std::shared_ptr<Principal>> principals;
    for (auto const& entry : read_tokens(file_)) principals.push_back(principal_of(entry));
    using std::filesystem::perms;
    if ((std::filesystem::status(file_).permissions() & (perms::group_read | perms::others_read)) != perms::none)
        spdlog::warn("tokens: other users may read {}: the mode 0600 is enough, if the file belongs to the user of the gateway",
                     file_);
    return principals;
}

void TokensFile::use(std::vector<std::shared_ptr<Principal>> principals) {
    auto const now = std::chrono::system_clock::now();
    auto const is_valid = [&](auto const& each) { return !each->expires || *each->expires > now; };
    auto const count = std::ranges::count_if(principals, is_valid);
    tokens_.set(std::move(principals));
    spdlog::info("tokens: {} of {} are valid from now on", count, file_);
}

void TokensFile::watch(std::stop_token const& stop) {
    std::mutex mutex;
    std::condition_variable_any never;
    std::unique_lock lock{mutex};
    while (!stop.stop_requested()) {
        never.wait_for(lock, stop, between_looks, [] { return false; });
        look();
    }
}

void TokensFile::look() {
    std::lock_guard const lock{mutex_};
    try {
        auto version = version_of(file_);
        if (version == version_) return;
        try {
            use(read());
            version_ = std::move(version);
            complaint_.clear();
        } catch (std::runtime_error const& error) {
            if (complaint_ != error.what()) spdlog::warn("{}; the tokens are those of before", error.what());
            complaint_ = error.what();
        }
    } catch (std::exception const&) {  // NOLINT(bugprone-empty-catch): there is no memory, and the next look tries again
    }
}

}  // namespace rois
