// The main header of server/xml: encodes and decodes the messages of schemas/messages.xsd. Encoding is thread-safe; readers are
// not.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "types/engine_state.hpp"
#include "types/floor_map.hpp"
#include "types/messages.hpp"

namespace rois::xml {

class Schemas;

// Limits of a document, checked before a parser sees it.
struct DocumentLimits {
    std::size_t bytes = 1 << 20;
    std::size_t depth = 64;
    std::size_t attributes = 32;    // per element
    std::size_t name_length = 256;  // bytes
    std::size_t elements = 5'000;
    std::size_t namespaces = 64;  // declarations in scope: of an element and its ancestors

    bool operator==(DocumentLimits const&) const = default;
};

// How documents are checked. Both ways accept the same documents and report the same faults.
enum class Validation : std::uint8_t {
    fast,  // with tables made from the schemas; if the tables do not accept a document, in full
    full,  // with a scan and xerces-c
};

// Validates and decodes requests. Keeps its parser, and replaces it when it uses too much memory. Not thread-safe.
class RequestReader {
public:
    explicit RequestReader(std::shared_ptr<Schemas const>, DocumentLimits = {}, Validation = Validation::fast);
    ~RequestReader();
    RequestReader(RequestReader&&) noexcept;

    // From now on, checks documents like this. Returns this reader.
    RequestReader& use(DocumentLimits const&, Validation);

    // Returns a fault for every invalid document, and never throws for one. The fault has the request_id if it could be read.
    std::variant<Request, Fault> read(std::string_view document);

    // How the last document was checked; empty if it was too large to be checked.
    std::optional<Validation> checked() const;

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

// Returns the document of an answer. An empty `request_id` is left out.
std::string encode(Reply const&, std::string_view request_id);
std::string encode(Fault const&);
std::string encode(StopState const&);
std::string encode(std::vector<EngineState> const&);

// A notification's document is its head, the digits of its sequence, and its tail. Only the digits differ between receivers. The
// head is a string literal.
std::string_view notification_head(Notification const&);
std::string notification_tail(Notification const&);

// The start and end tag of the answer of `/rois/notifications`; the documents of the notifications go between them.
std::string notifications_begin();
std::string notifications_end();

// Profile documents (7.5; the XML PSM of 2.0), with an XML declaration. `gml_id` is an NCName.
std::string encode(EngineProfile const&, std::string_view gml_id);
std::string encode(ComponentProfile const&, std::string_view gml_id);

// The document of /rois/map (schemas/map.xsd).
std::string encode(FloorMap const&);

// --- For clients ---

// Returns the document of a request. Throws std::invalid_argument for a condition that XML cannot express: one that contains
// NotUnderstood, or a group of components inside other predicates.
std::string encode(Request const&);

struct Answered {
    Reply reply;
    std::string request_id;
};
struct NumberedNotification {
    std::uint64_t sequence = 0;
    Notification notification;
};
using EngineMessage = std::variant<Answered, Fault, NumberedNotification>;  // a message that an engine sends

// Decodes messages of an engine. Does not validate: ignores what it does not know. Keeps its memory. Not thread-safe.
class AnswerReader {
public:
    AnswerReader();
    ~AnswerReader();
    AnswerReader(AnswerReader&&) noexcept;

    // Returns nothing, and never throws, if the document is not XML, not one of these messages, or lacks a mandatory part (a
    // return code, a sequence, ...).
    std::optional<EngineMessage> read(std::string_view document);

    // Reads an answer of /rois/stop or /rois/clear. Returns nothing for any other document.
    std::optional<StopState> read_stop_state(std::string_view document);
    // The same for an answer of /rois/engines.
    std::optional<std::vector<EngineState>> read_engines(std::string_view document);

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

// Returns whether the value of a Content-Type field is a media type of XML, in UTF-8 (RFC 7303).
bool is_xml_media_type(std::string_view content_type);

}  // namespace rois::xml
