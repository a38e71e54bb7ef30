// Says of most valid documents, in one pass over their bytes, that they are valid.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>
#include <vector>

#include "xml/codec.hpp"
#include "xml/known_tag.hpp"
#include "xml/message_tree.hpp"
#include "xml/plain_name.hpp"
#include "xml/schemas.hpp"
#include "xml/tables.hpp"

namespace rois::xml {

// Checks form, limits and validity together, with the tables of the schemas, and makes the tree of a message on the way. Once its
// stacks have grown it allocates nothing. Knows valid documents only: whatever it does not accept, for any reason, may still be
// valid (docs/validation.md). For one thread.
class Acceptor {
public:
    Acceptor(std::shared_ptr<Schemas const>, DocumentLimits);

    // Whether the document passes the scan without a change and is valid. False says nothing. The limit of bytes is the caller's
    // to check.
    bool accepts(std::string_view document);

    // The tree of a document that was accepted: views of its bytes, as long as these are there. Null when a text means something
    // else than what stands there, for a reference or a line end in it.
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
    // An element that is open: what it is called, and how far its content has come.
    struct Open {
        std::string_view tag;
        ElementDeclaration const* declaration;
        ElementType const* type;
        std::size_t begin;     // offset of its start tag
        std::size_t bindings;  // how many namespaces were declared before it
        std::uint32_t state;
    };

    // All of them: false when the document is left to xerces-c. What they take, they step over.
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

    // Of what stands next.
    KnownTag& known_tag();
    void remember(KnownTag&, PlainName const&, Interned::Id name_space, ElementDeclaration const&, std::size_t begin,
                  std::size_t outer_bindings);
    bool bind_again(KnownTag const&, char const* tag);
    bool take_text_element(KnownTag const&);

    PlainName take_name();
    ElementDeclaration const* declaration_of(Name);  // null: left to xerces-c; steps on in the open element's content
    // The declared one, or its xsi:type's, whose name is told then; null: left to xerces-c.
    ElementType const* type_of(ElementDeclaration const&, std::string_view& xsi_type);
    Interned::Id name_space_of(std::string_view prefix) const;

    char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
    bool at(std::string_view wanted) const {
        return text_.size() - at_ >= wanted.size() && std::memcmp(text_.data() + at_, wanted.data(), wanted.size()) == 0;
    }
    bool skip_white_space() {  // whether there was any
        auto const begin = at_;
        while (at_ < text_.size() && is_white_space(text_[at_])) ++at_;
        return at_ > begin;
    }
    static constexpr bool is_white_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
    void skip_until(std::array<bool, 256> const& ends);

    std::shared_ptr<Schemas const> schemas_;
    Tables const& tables_;
    DocumentLimits limits_;

    // Of one document; what they hold is kept for the next.
    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t elements_ = 0;
    bool as_written_ = true;
    bool plain_text_ = true;   // there is no `&` and no `]` anywhere
    std::uint64_t scope_ = 0;  // what prefixes mean: the same number, the same meanings; 0: nobody knows
    std::vector<Open> open_;
    std::vector<Binding> bindings_;
    std::vector<Attribute> attributes_;  // of one start tag
    std::vector<std::string_view> ids_;
    MessageTree tree_;

    // Of all documents so far: the root's, and one for each state of the tables by its number.
    std::vector<KnownTag> known_;
    std::uint64_t scopes_ = 0;  // that were numbered
};

}  // namespace rois::xml
