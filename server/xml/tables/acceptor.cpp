#include "xml/tables/acceptor.hpp"

#include <algorithm>
#include <array>
#include <ranges>
#include <utility>

#include "xml/codec/characters.hpp"
#include "xml/codec/names.hpp"
#include "xml/tables/start_tag.hpp"
#include "xml/validation/grammars.hpp"
#include "xml/validation/scan.hpp"

namespace rois::xml {

namespace {

// The bytes that end a run of plain text in content; `ends_value`: in an attribute.
constexpr auto ends_text = bytes_of("<&]");
constexpr auto ends_value = bytes_of("<&\"'\t\n");

// Prefixes that begin with "xml", in any case, are reserved.
bool is_reserved(std::string_view prefix) {
    auto const lower = [&](std::size_t i) { return static_cast<char>(prefix[i] | 0x20); };
    return prefix.size() >= 3 && lower(0) == 'x' && lower(1) == 'm' && lower(2) == 'l';
}

}  // namespace

Acceptor::Acceptor(std::shared_ptr<Schemas const> schemas, DocumentLimits limits)
    : schemas_{std::move(schemas)}, tables_{schemas_->grammars().tables()}, limits_{limits}, known_(tables_.states() + 1) {}

bool Acceptor::accepts(std::string_view document) {
    text_ = document;
    at_ = 0;
    elements_ = 0;
    open_.clear();
    bindings_.clear();
    ids_.clear();
    tree_.clear();
    scope_ = 0;
    as_written_ = document.find('\r') == document.npos;
    plain_text_ = document.find('&') == document.npos && document.find(']') == document.npos;
    if (first_bad_character(document) || !prologue() || !start_tag()) return false;
    while (!open_.empty()) {
        if (!content()) return false;
    }
    return between_elements() && at_ == text_.size();
}

// Takes one of the usual XML declarations, and comments.
bool Acceptor::prologue() {
    constexpr std::array<std::string_view, 6> declarations{R"(<?xml version="1.0" encoding="UTF-8"?>)",
                                                           R"(<?xml version="1.0" encoding="utf-8"?>)",
                                                           R"(<?xml version='1.0' encoding='UTF-8'?>)",
                                                           R"(<?xml version='1.0' encoding='utf-8'?>)",
                                                           R"(<?xml version="1.0"?>)",
                                                           R"(<?xml version='1.0'?>)"};
    if (at("<?")) {
        auto const* const declaration = std::ranges::find_if(declarations, [this](auto each) { return at(each); });
        if (declaration != declarations.end()) at_ += declaration->size();
    }
    return between_elements() && peek() == '<';
}

bool Acceptor::between_elements() {
    for (;;) {
        skip_white_space();
        if (!at("<!--")) return true;
        if (!comment()) return false;
    }
}

void Acceptor::skip_until(std::array<bool, 256> const& ends) {
    auto end = at_;
    while (end < text_.size() && !ends[static_cast<unsigned char>(text_[end])]) ++end;
    at_ = end;
}

// Takes text in the innermost open element, and the markup after it.
bool Acceptor::content() {
    auto const begin = at_;
    switch (open_.back().type->content) {
        case ElementType::Content::value:
            return value() && end_tag();
        case ElementType::Content::elements:
            skip_white_space();
            break;
        case ElementType::Content::mixed:
            if (!text()) return false;
            break;
        default:
            return end_tag();
    }
    if (at_ > begin) tree_.add_text(text_.substr(begin, at_ - begin));
    if (peek() != '<') return false;
    if (peek(1) == '/') return end_tag();
    return peek(1) == '!' ? comment() : start_tag();
}

bool Acceptor::comment() {
    if (!at("<!--")) return false;
    auto const end = text_.find("--", at_ + 4);
    if (end == text_.npos || end + 2 >= text_.size() || text_[end + 2] != '>') return false;
    at_ = end + 3;
    return true;
}

// Takes text up to the next markup.
bool Acceptor::text() {
    if (plain_text_) {
        at_ = std::min(text_.find('<', at_), text_.size());
        return at_ < text_.size();
    }
    for (;;) {
        skip_until(ends_text);
        switch (peek()) {
            case '<':
                return true;
            case '&':
                if (!reference()) return false;
                break;
            case ']':
                if (at("]]>")) return false;
                ++at_;
                break;
            default:
                return false;  // end of the document
        }
    }
}

// Takes the text of an element that holds only text.
bool Acceptor::value() {
    auto const& open = open_.back();
    auto const begin = at_;
    if (open.type->value->takes_any_text()) {
        if (!text()) return false;
    } else {
        at_ = std::min(text_.find('<', at_), text_.size());
        if (!check(*open.type->value, text_.substr(begin, at_ - begin))) return false;
    }
    tree_.add_text(text_.substr(begin, at_ - begin));
    return !open.declaration->of_limited_length || at_ - open.begin <= longest_list;
}

bool Acceptor::reference() {
    constexpr std::array<std::string_view, 5> entities{"&lt;", "&gt;", "&amp;", "&quot;", "&apos;"};
    as_written_ = false;
    if (peek(1) == '#') return character_reference();
    auto const* const entity = std::ranges::find_if(entities, [this](auto each) { return at(each); });
    if (entity == entities.end()) return false;
    at_ += entity->size();
    return true;
}

bool Acceptor::character_reference() {
    constexpr std::size_t most_digits = 7;
    bool const hexadecimal = peek(2) == 'x';
    char32_t const base = hexadecimal ? 16 : 10;
    char32_t code = 0;
    at_ += hexadecimal ? 3 : 2;
    auto const begin = at_;
    for (; peek() != ';'; ++at_) {
        auto const c = peek();
        auto const lower = static_cast<char>(c | 0x20);
        bool const is_digit = c >= '0' && c <= '9';
        bool const is_letter = hexadecimal && lower >= 'a' && lower <= 'f';
        if ((!is_digit && !is_letter) || at_ - begin == most_digits) return false;
        code = code * base + static_cast<char32_t>(is_digit ? c - '0' : lower - 'a' + 10);
    }
    if (at_ == begin || !is_character(code)) return false;
    ++at_;
    return true;
}

// Returns an empty name if xerces-c must decide about the document.
PlainName Acceptor::take_name() {
    auto name = plain_name_before(text_.substr(at_));
    if (name.whole().size() > limits_.name_length) name = {};
    at_ += name.whole().size();
    return name;
}

bool Acceptor::start_tag() {
    auto& known = known_tag();
    bool const is_known = !known.text.empty() && at(known.text) && take(known);
    return is_known || new_start_tag(known);
}

bool Acceptor::new_start_tag(KnownTag& known) {
    auto const begin = at_;
    auto const outer_bindings = bindings_.size();
    ++at_;
    if (++elements_ > limits_.elements || open_.size() == limits_.depth) return false;
    auto const name = take_name();
    if (name.none() || !attributes(outer_bindings) || !resolve_attributes()) return false;
    if (bindings_.size() > outer_bindings) scope_ = 0;
    auto const name_space = name_space_of(name.prefix());
    auto const* const declaration = declaration_of({name_space, tables_.name(name.local())});
    std::string_view xsi_type;
    auto const* const type = declaration == nullptr ? nullptr : type_of(*declaration, xsi_type);
    if (type == nullptr || type->content == ElementType::Content::unknown) return false;
    if (open_.empty()) tree_.set_name_space(tables_.text(name_space));
    tree_.open(name.local(), xsi_type);
    if (!check_attributes(*type)) return false;
    open_.emplace_back(name.whole(), declaration, type, begin, outer_bindings, 0);
    if (peek() == '>') {
        ++at_;
        if (attributes_.empty()) remember(known, name, name_space, *declaration, begin, outer_bindings);
        return true;
    }
    if (!at("/>")) return false;
    at_ += 2;
    return (type->content != ElementType::Content::value || check(*type->value, {})) && close();
}

bool Acceptor::end_tag() {
    auto const tag = open_.back().tag;
    if (!at("</")) return false;
    at_ += 2;
    if (!at(tag)) return false;
    at_ += tag.size();
    if (peek() != '>') return false;
    ++at_;
    return close();
}

// Closes the innermost element. Returns false if its content is incomplete.
bool Acceptor::close() {
    auto const& element = open_.back();
    auto const& states = element.type->states;
    if (!states.empty() && !states[element.state].final) return false;
    if (bindings_.size() > element.bindings) bindings_.resize(element.bindings);
    open_.pop_back();
    tree_.close();
    return true;
}

// Takes the attributes up to the end of the start tag.
bool Acceptor::attributes(std::size_t outer_bindings) {
    attributes_.clear();
    for (std::size_t count = 1;; ++count) {
        bool const apart = skip_white_space();
        if (peek() == '>' || peek() == '/') return true;
        if (!apart || count > limits_.attributes || !attribute(outer_bindings)) return false;
    }
}

bool Acceptor::attribute(std::size_t outer_bindings) {
    auto const written = take_name();
    if (written.none() || peek() != '=') return false;
    ++at_;
    std::string_view value;
    if (!attribute_value(value)) return false;
    if (written.whole() == "xmlns") return bind({}, value, outer_bindings);
    if (written.prefix() == "xmlns") return bind(written.local(), value, outer_bindings);
    attributes_.push_back({written, value, {}});
    return true;
}

bool Acceptor::attribute_value(std::string_view& value) {
    auto const quote = peek();
    if (quote != '"' && quote != '\'') return false;
    auto const begin = ++at_;
    for (;;) {
        skip_until(ends_value);
        if (peek() == quote) break;
        if (at_ == text_.size() || peek() == '<') return false;
        if (peek() == '&') {
            if (!reference()) return false;
            continue;
        }
        if (peek() == '\t' || peek() == '\n') as_written_ = false;
        ++at_;  // white space, or the other kind of quote
    }
    value = text_.substr(begin, at_ - begin);
    ++at_;
    return true;
}

// Returns false if the namespace is unknown or this tag has already declared the prefix.
bool Acceptor::bind(std::string_view prefix, std::string_view name_space, std::size_t outer_bindings) {
    auto const id = tables_.name_space(name_space);
    if (id == Interned::unknown || is_reserved(prefix)) return false;
    for (auto i = outer_bindings; i < bindings_.size(); ++i) {
        if (bindings_[i].prefix == prefix) return false;
    }
    bindings_.push_back({prefix, id});
    return bindings_.size() <= limits_.namespaces;
}

Interned::Id Acceptor::name_space_of(std::string_view prefix) const {
    auto const innermost_first = bindings_ | std::views::reverse;
    auto const found = std::ranges::find(innermost_first, prefix, &Binding::prefix);
    if (found != innermost_first.end()) return found->name_space;
    return prefix.empty() ? Interned::empty : Interned::unknown;
}

bool Acceptor::resolve_attributes() {
    for (auto& [written, value, name] : attributes_) {
        name.local = tables_.name(written.local());
        if (written.prefix().empty()) {
            name.name_space = Interned::empty;
        } else {
            name.name_space = written.prefix() == "xml" ? tables_.name(xml_namespace) : name_space_of(written.prefix());
        }
        if (name.local == Interned::unknown || name.name_space == Interned::unknown) return false;
    }
    return true;
}

ElementDeclaration const* Acceptor::declaration_of(Name name) {
    if (open_.empty()) return elements_ == 1 ? tables_.root(name) : nullptr;
    auto& [tag, declaration, type, begin, bindings, state] = open_.back();
    auto const& transitions = type->states[state].transitions;
    auto const found = std::ranges::find(transitions, name, &ContentState::Transition::name);
    if (found == transitions.end()) return nullptr;
    state = found->state;
    return found->element;
}

ElementType const* Acceptor::type_of(ElementDeclaration const& declaration, std::string_view& xsi_type) {
    auto const said = std::ranges::find(attributes_, tables_.xsi_type(), &Attribute::name);
    if (said == attributes_.end()) return declaration.type;
    auto const written = plain_name(said->value);
    if (written.none()) return nullptr;
    xsi_type = written.local();
    Name const name{name_space_of(written.prefix()), tables_.name(written.local())};
    auto const found = std::ranges::find(declaration.substitutes, name, &std::pair<Name, ElementType const*>::first);
    return found == declaration.substitutes.end() ? nullptr : found->second;
}

// Returns false if an attribute is unknown to the type, invalid or duplicate, or a required one is missing.
bool Acceptor::check_attributes(ElementType const& type) {
    std::uint64_t there = 0;
    bool has_type = false;
    for (auto const& [written, value, name] : attributes_) {
        if (name == tables_.xsi_type()) {
            if (std::exchange(has_type, true)) return false;
            continue;
        }
        auto const found = std::ranges::find(type.attributes, name, &AttributeUse::name);
        if (found == type.attributes.end() || !check(*found->type, value)) return false;
        auto const bit = std::uint64_t{1} << (found - type.attributes.begin());
        if ((there & bit) != 0) return false;
        there |= bit;
        tree_.add_attribute(written.local(), value);
    }
    return (there & type.required) == type.required;
}

// Returns false if the id is a duplicate, or the document has more than `most_ids` ids (xerces-c then decides).
bool Acceptor::is_new(std::string_view id) {
    constexpr std::size_t most_ids = 16;
    if (ids_.size() == most_ids || std::ranges::find(ids_, id) != ids_.end()) return false;
    ids_.push_back(id);
    return true;
}

bool Acceptor::check(ValueType const& type, std::string_view value) {
    if (!type.accepts(value)) return false;
    if (type.kind == ValueType::Kind::id) return is_new(value);
    if (type.kind != ValueType::Kind::qualified_name) return true;
    auto const written = plain_name(value);
    return written.prefix().empty() || name_space_of(written.prefix()) != Interned::unknown;
}

}  // namespace rois::xml
