// Validates most valid documents in one pass over their bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>
#include <vector>

#include "xml/codec/codec.hpp"
#include "xml/codec/message_tree.hpp"
#include "xml/tables/known_tag.hpp"
#include "xml/tables/plain_name.hpp"
#include "xml/tables/tables.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::xml {

// Checks form, limits and validity with the tables of the schemas, and builds the message tree in the same pass. It is
// conservative: a document that it does not accept may still be valid, and xerces-c decides (docs/validation.md). Allocates
// nothing once its stacks have grown. Not thread-safe.
class Acceptor {
public:
    Acceptor(std::shared_ptr<Schemas const>, DocumentLimits);

    // Returns true if the document is valid and the scan would not change it. False means that the document may be valid or not.
    // The caller checks the limit of bytes.
    bool accepts(std::string_view document);

    // Returns the tree of the accepted document: views of the document's bytes, valid as long as these. Null if a text contains
    // a reference or a line end to normalise, so that its value differs from its bytes.
    MessageTree const* tree() const { return as_written_ ? &tree_ : nullptr; }

private:
    struct Attribute {
        PlainName written;
        std::string_view value;
        Name name;
    };
    struct Binding {
        std::string_view prefix;
        Interned::Id name_space = Interned::empty;
    };
    struct Open {  // an open element
        std::string_view tag;
        ElementDeclaration const* declaration;
        ElementType const* type;
        std::size_t begin;     // offset of its start tag
        std::size_t bindings;  // size of `bindings_` before its start tag
        std::uint32_t state;   // of its content model
    };

    // Each of these functions moves behind the part that it accepts. It returns false if xerces-c must decide about the document.
    bool prologue();
    bool between_elements();
    bool content();
    bool comment();
    bool text();
    bool value();
    bool reference();
    bool character_reference();
    bool start_tag();
    bool take(KnownTag&);
    bool new_start_tag(KnownTag&);
    bool attributes(std::size_t outer_bindings);
    bool attribute(std::size_t outer_bindings);
    bool attribute_value(std::string_view& value);
    bool bind(std::string_view prefix, std::string_view name_space, std::size_t outer_bindings);
    bool resolve_attributes();
    bool check_attributes(ElementType const&);
    bool check(ValueType const&, std::string_view text);
    bool is_new(std::string_view id);
    bool end_tag();
    bool close();

    KnownTag& known_tag();  // of the current position
    void remember(KnownTag&, PlainName const&, Interned::Id name_space, ElementDeclaration const&, std::size_t begin,
                  std::size_t outer_bindings);
    bool bind_again(KnownTag const&, char const* tag);
    bool take_text_element(KnownTag const&);

    PlainName take_name();
    // Advances the content model of the innermost open element. Returns null if xerces-c must decide.
    ElementDeclaration const* declaration_of(Name);
    // Returns the declared type, or the type that the tag's xsi:type names; then sets `xsi_type` to its local name. Returns null
    // if xerces-c must decide.
    ElementType const* type_of(ElementDeclaration const&, std::string_view& xsi_type);
    Interned::Id name_space_of(std::string_view prefix) const;

    char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
    bool at(std::string_view wanted) const {
        return text_.size() - at_ >= wanted.size() && std::memcmp(text_.data() + at_, wanted.data(), wanted.size()) == 0;
    }
    bool skip_white_space() {  // returns whether it skipped any
        auto const begin = at_;
        while (at_ < text_.size() && is_white_space(text_[at_])) ++at_;
        return at_ > begin;
    }
    static constexpr bool is_white_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
    void skip_until(std::array<bool, 256> const& ends);

    std::shared_ptr<Schemas const> schemas_;
    Tables const& tables_;
    DocumentLimits limits_;

    // State of the current document; the memory is reused for the next one.
    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t elements_ = 0;
    bool as_written_ = true;
    bool plain_text_ = true;   // the document contains no `&` and no `]`
    std::uint64_t scope_ = 0;  // number of the current set of namespace bindings; 0: not numbered
    std::vector<Open> open_;
    std::vector<Binding> bindings_;
    std::vector<Attribute> attributes_;  // of one start tag
    std::vector<std::string_view> ids_;
    MessageTree tree_;

    // Cached start tags, kept across documents: index 0 for the root, then one for each content state by its number.
    std::vector<KnownTag> known_;
    std::uint64_t scopes_ = 0;  // numbers given to scopes so far
};

}  // namespace rois::xml
