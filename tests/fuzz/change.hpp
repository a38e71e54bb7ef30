// One change of a document, of many kinds. change_*.cpp has the changes by the part that they change.
#pragma once

#include <algorithm>
#include <cstddef>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fuzz/markup.hpp"

namespace rois::fuzz {

// One document that is being changed.
class Change {
public:
    Change(std::string text, std::vector<std::string> const& others, std::mt19937_64& random)
        : text_{std::move(text)}, others_{others}, random_{random}, tags_{tags_of(text_)} {}

    std::string apply();

private:
    std::size_t any(std::size_t below) { return static_cast<std::size_t>(random_() % std::max<std::size_t>(below, 1)); }
    bool one_in(std::size_t n) { return any(n) == 0; }

    template <class Pieces>
    std::string_view any_of(Pieces const& pieces) {
        return pieces[any(pieces.size())];
    }

    std::string part(Range range) const { return text_.substr(range.begin, range.size()); }
    void put(Range range, std::string_view instead) { text_.replace(range.begin, range.size(), instead); }
    void put(std::size_t at, std::string_view what) { text_.insert(std::min(at, text_.size()), what); }

    std::size_t any_start_tag();  // an index; the number of tags if no start tag exists
    // Chooses a tag with one of these local names, or any tag if no tag has one of them.
    template <class Names>
    std::size_t any_start_tag_of(Names const& names);
    std::pair<std::size_t, Range> any_attribute();  // its tag, the number of tags when there is none
    Range any_text();                               // between two tags
    std::size_t any_gap() { return tags_.empty() ? any(text_.size()) : tags_[any(tags_.size())].all.end; }
    void rename(std::size_t tag, std::string_view name);

    void change_a_byte();
    void delete_bytes();
    void insert_a_piece();
    void cut_short();
    void double_an_element();
    void delete_an_element();
    void move_an_element();
    void take_an_element_from_another();
    void exchange_elements();
    void rename_an_element();
    void change_a_prefix();
    void rename_a_prefix_everywhere();
    void double_an_attribute();
    void delete_an_attribute();
    void move_an_attribute();
    void add_an_attribute();
    void change_a_value();
    void change_a_text();
    void change_a_namespace();
    void declare_a_namespace();
    void change_a_type();
    void add_white_space();
    void add_a_comment();
    void write_a_character_as_reference();
    void nest_deeply();
    void repeat_often();
    void lengthen_a_name();
    void change_quotes();
    void push_apart();
    void declare_many_namespaces();

    std::string text_;
    std::vector<std::string> const& others_;
    std::mt19937_64& random_;
    std::vector<Tag> tags_;
};

template <class Names>
std::size_t Change::any_start_tag_of(Names const& names) {
    auto const first = any(tags_.size());
    for (std::size_t i = 0; i < tags_.size(); ++i) {
        auto const at = (first + i) % tags_.size();
        auto const name = part(tags_[at].name);
        auto const local = std::string_view{name}.substr(name.find(':') + 1);
        if (tags_[at].kind != Tag::Kind::end && std::ranges::find(names, local) != names.end()) return at;
    }
    return any_start_tag();
}

}  // namespace rois::fuzz
