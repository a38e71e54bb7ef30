// Text <-> messages: the only place that knows how the messages of wire.md look. Encoding is pure and may be called from any
// thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "types/messages.hpp"

namespace rois::xml {

class Schemas;

// The limits of a document, checked before any parser sees it (bad-input 3).
struct DocumentLimits {
    std::size_t bytes = 1 << 20;
    std::size_t depth = 64;
    std::size_t attributes = 32;    // an element
    std::size_t name_length = 256;  // bytes
    std::size_t elements = 5'000;
    std::size_t namespaces = 64;  // declarations in scope: of an element and those around it
};

// How documents are checked. The verdict and its words are the same.
enum class Validation : std::uint8_t {
    fast,  // with tables made from the schemas; what these do not accept goes the full way
    full,  // with a scan and xerces-c
};

// Reads requests: checks the bytes, validates against the schemas, and gives the operation. Keeps its parser and replaces it on a
// schedule; one for each thread.
class RequestReader {
public:
    explicit RequestReader(std::shared_ptr<Schemas const>, DocumentLimits = {}, Validation = Validation::fast);
    ~RequestReader();
    RequestReader(RequestReader&&) noexcept;

    // Never throws for anything that the document says; a fault has the request_id when that could be read.
    std::variant<Request, Fault> read(std::string_view document);

    // Which way the last document was checked; nothing for one that was too large to be looked at.
    std::optional<Validation> checked() const;

private:
    class Kept;
    std::unique_ptr<Kept> kept_;
};

// The answer's document. `request_id` is left out when empty.
std::string encode(Reply const&, std::string_view request_id);
std::string encode(Fault const&);
std::string encode(StopState const&);

// A notification's document is `head(n)`, the digits of its sequence and `tail(n)`: but for the digits it is the same for all its
// receivers. The head is a text of the program.
std::string_view notification_head(Notification const&);
std::string notification_tail(Notification const&);

// The document that `/rois/notifications` answers: `<notifications>` with the given documents inside.
std::string notifications_begin();
std::string notifications_end();

// Profile documents (7.5; the XML PSM of 2.0), with an XML declaration. `gml_id` is an NCName.
std::string encode(EngineProfile const&, std::string_view gml_id);
std::string encode(ComponentProfile const&, std::string_view gml_id);

// --- The same from the other side, for clients ---

// A request's document. Throws std::invalid_argument for a condition that XML cannot say: one that was not understood, or a group
// of components inside other predicates.
std::string encode(Request const&);

struct Answered {
    Reply reply;
    std::string request_id;
};
struct Told {
    std::uint64_t sequence = 0;
    Notification notification;
};
using Heard = std::variant<Answered, Fault, Told>;

// Reads what an engine says. An engine is not asked to be valid: what is there is read, and what is more is passed over. Keeps
// its memory; for one thread.
class AnswerReader {
public:
    AnswerReader();
    ~AnswerReader();
    AnswerReader(AnswerReader&&) noexcept;

    // Nothing when the document is no XML, none of these, or lacks what it must have (a return code, a sequence, ...). Never
    // throws for anything that the document says.
    std::optional<Heard> read(std::string_view document);

    // Reads what /rois/stop and /rois/clear answer with. Nothing for any other document.
    std::optional<StopState> read_stop_state(std::string_view document);

private:
    class Kept;
    std::unique_ptr<Kept> kept_;
};

}  // namespace rois::xml
