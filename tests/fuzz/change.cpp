#include "fuzz/change.hpp"

#include <array>
#include <utility>

#include "fuzz/pieces.hpp"

namespace rois::fuzz {

std::string Change::apply() {
    using Kind = void (Change::*)();
    constexpr std::array<Kind, 38> kinds{
        &Change::change_a_byte, &Change::delete_bytes, &Change::insert_a_piece, &Change::cut_short, &Change::double_an_element,
        &Change::delete_an_element, &Change::move_an_element, &Change::take_an_element_from_another, &Change::exchange_elements,
        &Change::rename_an_element, &Change::change_a_prefix, &Change::rename_a_prefix_everywhere, &Change::double_an_attribute,
        &Change::delete_an_attribute, &Change::move_an_attribute, &Change::add_an_attribute, &Change::change_a_value,
        &Change::change_a_text, &Change::change_a_namespace, &Change::declare_a_namespace, &Change::change_a_type,
        &Change::add_white_space, &Change::add_a_comment, &Change::write_a_character_as_reference, &Change::nest_deeply,
        &Change::repeat_often, &Change::lengthen_a_name, &Change::change_quotes, &Change::push_apart,
        &Change::declare_many_namespaces,
        // What keeps a document near to validity, once more.
        &Change::change_a_value, &Change::change_a_text, &Change::change_a_text, &Change::double_an_element,
        &Change::delete_an_element, &Change::take_an_element_from_another, &Change::exchange_elements, &Change::add_an_attribute};
    (this->*kinds[any(kinds.size())])();
    if (text_.empty()) text_ = "<";
    return std::move(text_);
}

std::size_t Change::any_start_tag() {
    auto const first = any(tags_.size());
    for (std::size_t i = 0; i < tags_.size(); ++i) {
        auto const at = (first + i) % tags_.size();
        if (tags_[at].kind != Tag::Kind::end) return at;
    }
    return tags_.size();
}

std::pair<std::size_t, Range> Change::any_attribute() {
    auto const first = any(tags_.size());
    for (std::size_t i = 0; i < tags_.size(); ++i) {
        auto const at = (first + i) % tags_.size();
        auto const& attributes = tags_[at].attributes;
        if (!attributes.empty()) return {at, attributes[any(attributes.size())]};
    }
    return {tags_.size(), {}};
}

Range Change::any_text() {
    if (tags_.size() < 2) return {};
    auto at = any(tags_.size() - 1);
    // An element that holds text alone, if there is one near.
    for (std::size_t i = 0; i < 8; ++i, at = (at + 1) % (tags_.size() - 1)) {
        if (tags_[at].kind == Tag::Kind::start && tags_[at].counterpart == at + 1) break;
    }
    return {tags_[at].all.end, tags_[at + 1].all.begin};
}

void Change::rename(std::size_t tag, std::string_view name) {
    auto one = tag, other = tags_[tag].counterpart.value_or(tag);
    if (one < other) std::swap(one, other);  // the later one first, so that the other one stays where it is
    put(tags_[one].name, name);
    if (one != other && !one_in(10)) put(tags_[other].name, name);
}

void Change::change_a_byte() {
    auto& byte = text_[any(text_.size())];
    byte = one_in(2) ? static_cast<char>(any(256)) : any_of(bytes).front();
}

void Change::delete_bytes() { text_.erase(any(text_.size()), 1 + any(one_in(2) ? 3 : 20)); }

void Change::insert_a_piece() { put(one_in(2) ? any_gap() : any(text_.size()), any_of(pieces)); }

void Change::cut_short() {
    if (one_in(4)) text_.resize(any(text_.size()));
}

}  // namespace rois::fuzz
