// What the journal stores, as records: a kind, the session, a key, and a text (docs/journal.md).
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/journal/journal.hpp"

namespace rois::xml {
class Schemas;
}

namespace rois::journal {

// Kinds, in the order in which `read` returns them.
namespace kind {
inline constexpr auto command = "command";            // key: its id
inline constexpr auto engine = "engine";              // one record, of session 0
inline constexpr auto notification = "notification";  // key: its sequence, with as many digits as the largest one has
inline constexpr auto session = "session";            // no key
inline constexpr auto subscription = "subscription";  // key: its id
}  // namespace kind

struct Key {
    std::string kind;
    std::uint64_t session = 0;
    std::string key;
    auto operator<=>(Key const&) const = default;
};

struct Record {
    Key key;
    std::string value;
};

// Changes of records, in the order in which they apply.
struct RecordChanges {
    std::vector<Key> gone{};
    struct Range {
        Key first;
        std::string last;  // key
    };
    std::vector<Range> forgotten{};
    std::vector<Record> set{};
    std::vector<std::uint64_t> ended{};  // all records of these sessions
};

RecordChanges records_of(Changes const&);

// A record cannot be read. The message says which one, and why.
class BadRecord : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// Throws BadRecord. The records must be ordered by their keys.
StoredState state_of(std::vector<Record> const&, std::shared_ptr<xml::Schemas const> const&);

}  // namespace rois::journal
