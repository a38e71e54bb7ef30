#include "xml/validation/joining.hpp"

#include <array>
#include <pugixml.hpp>

#include "types/codes.hpp"
#include "types/text/texts.hpp"
#include "xml/codec/decoding.hpp"
#include "xml/codec/names.hpp"
#include "xml/codec/tree.hpp"
#include "xml/codec/writer.hpp"
#include "xml/validation/checked_reader.hpp"

namespace rois::xml {

namespace {

constexpr std::array<std::string_view, 1> roots{"join"};
constexpr DocumentLimits small{.bytes = 4'096, .depth = 4, .elements = 4};

}  // namespace

std::string encode(Join const& join) {
    Writer out;
    out.start("join")
        .constant("xmlns", message_namespace)
        .attribute("name", join.name)
        .attribute("instance", join.instance)
        .end();
    return std::move(out).written();
}

std::string encode(JoinResponse const& response) {
    Writer out;
    out.start("join_response").constant("xmlns", message_namespace).constant("return_code", to_text(response.return_code));
    if (response.return_code == ReturnCode::ok)
        out.attribute("window", static_cast<std::uint64_t>(response.window.count()));
    else
        out.element("reason", response.reason);
    out.end();
    return std::move(out).written();
}

std::optional<JoinResponse> read_join_response(std::string_view document) {
    pugi::xml_document tree;
    MessageTree message;
    if (!tree.load_buffer(document.data(), document.size(), as_xerces_reads, pugi::encoding_utf8)) return {};
    if (!message.read(tree.document_element(), small.depth)) return {};
    auto const root = message.root();
    auto const code = to_code<ReturnCode>(root.attribute("return_code").value_or(""));
    if (message.name_space() != message_namespace || root.name() != "join_response" || !code) return {};
    JoinResponse response;
    response.return_code = *code;
    response.reason = root.child("reason").text();
    response.window = std::chrono::milliseconds{decode_integer(root.attribute("window").value_or("0"))};
    return response;
}

JoinReader::JoinReader(std::shared_ptr<Schemas const> schemas)
    : reader_{std::make_unique<CheckedReader>(std::move(schemas), small, roots)} {}

JoinReader::~JoinReader() = default;

std::variant<Join, Fault> JoinReader::read(std::string_view document) {
    if (auto fault = reader_->read(document)) return *fault;
    auto const root = reader_->message().root();
    if (root.name() != "join") {
        auto const name = quoted(root.name());
        return reader_->complain(reader_->root(), "unexpected element " + name + ": the first document of an engine is 'join'");
    }
    return Join{std::string{root.attribute("name").value_or("")}, std::string{root.attribute("instance").value_or("")}};
}

}  // namespace rois::xml
