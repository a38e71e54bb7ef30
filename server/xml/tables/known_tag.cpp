#include "xml/tables/known_tag.hpp"

#include <cstring>
#include <ranges>

#include "xml/tables/acceptor.hpp"

namespace rois::xml {

KnownTag& Acceptor::known_tag() {
    if (open_.empty()) return known_.front();
    auto const& [tag, declaration, type, begin, bindings, state] = open_.back();
    return known_[type->states[state].number];
}

// Returns false if the prefix is bound to another namespace here, or a limit is reached.
bool Acceptor::take(KnownTag& known) {
    auto const* const tag = text_.data() + at_;
    auto const outer_bindings = bindings_.size();
    if (elements_ == limits_.elements || open_.size() == limits_.depth) return false;
    bool const same_scope = scope_ != 0 && known.scope == scope_;
    if (!same_scope && !bind_again(known, tag)) {
        bindings_.resize(outer_bindings);
        return false;
    }
    ++elements_;
    if (open_.empty()) {
        tree_.set_name_space(tables_.text(known.name_space));
        scope_ = known.scope;
    } else {
        open_.back().state = known.next_state;
        known.scope = scope_;
        if (same_scope && known.holds_text && plain_text_ && take_text_element(known)) return true;
    }
    tree_.open(known.local.of(tag), {});
    open_.emplace_back(known.name.of(tag), known.declaration, known.declaration->type, at_, outer_bindings, 0);
    at_ += known.text.size();
    return true;
}

// Also takes the element's text and end tag, if they follow. Otherwise returns false and takes nothing.
bool Acceptor::take_text_element(KnownTag const& known) {
    auto const* const tag = text_.data() + at_;
    auto const name = known.name.of(tag);
    auto const begin = at_ + known.text.size();
    auto const end = text_.find('<', begin);
    if (end == text_.npos || text_.size() - end < name.size() + 3) return false;
    auto const* const end_tag = text_.data() + end;
    if (end_tag[1] != '/' || std::memcmp(end_tag + 2, name.data(), name.size()) != 0 || end_tag[2 + name.size()] != '>')
        return false;
    tree_.open(known.local.of(tag), {});
    tree_.add_text(text_.substr(begin, end - begin));
    tree_.close();
    at_ = end + name.size() + 3;
    return true;
}

// Binds the namespaces that the tag declares, which ends the scope. Returns false if its prefix has another namespace here.
bool Acceptor::bind_again(KnownTag const& known, char const* tag) {
    for (auto const& each : known.namespaces) bindings_.push_back({each.prefix.of(tag), each.name_space});
    if (!known.namespaces.empty()) scope_ = 0;
    return bindings_.size() <= limits_.namespaces && name_space_of(known.prefix.of(tag)) == known.name_space;
}

// Caches the tag that was just read. It must have no attributes and its declared type.
void Acceptor::remember(KnownTag& known, PlainName const& name, Interned::Id name_space, ElementDeclaration const& declaration,
                        std::size_t begin, std::size_t outer_bindings) {
    if (at_ - begin > KnownTag::longest) return;
    auto const part = [&](std::string_view text) {
        bool const inside = !text.empty();
        return KnownTag::Part{inside ? static_cast<std::size_t>(text.data() - text_.data()) - begin : 0, text.size()};
    };
    known.text = text_.substr(begin, at_ - begin);
    known.name = part(name.whole());
    known.prefix = part(name.prefix());
    known.local = part(name.local());
    known.namespaces.clear();
    for (auto const& [prefix, id] : bindings_ | std::views::drop(outer_bindings)) known.namespaces.push_back({part(prefix), id});
    known.name_space = name_space;
    known.declaration = &declaration;
    known.holds_text = declaration.type->content == ElementType::Content::value && declaration.type->value->takes_any_text() &&
                       !declaration.of_limited_length;
    bool const root = open_.size() == 1;
    if (root) scope_ = ++scopes_;
    known.scope = scope_;
    if (!root) known.next_state = open_[open_.size() - 2].state;
}

}  // namespace rois::xml
