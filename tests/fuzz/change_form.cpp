#include "fuzz/change.hpp"

#include <algorithm>

#include "fuzz/pieces.hpp"

namespace rois::fuzz {

void Change::add_white_space() {
    auto const at = one_in(2) ? any_gap() : text_.find_first_of("=\"'<>/ :", any(text_.size()));
    put(at == text_.npos ? 0 : at + any(2), any_of(blanks));
}

void Change::add_a_comment() { put(one_in(3) ? any(text_.size()) : any_gap(), any_of(comments)); }

void Change::write_a_character_as_reference() {
    auto const at = any(text_.size());
    auto const code = static_cast<unsigned char>(text_[at]);
    auto const number = std::to_string(code);
    if (code < 0x80) put({at, at + 1}, one_in(2) ? "&#" + number + ";" : std::string{any_of(references)});
}

void Change::nest_deeply() {
    auto const tag = one_in(2) ? any_start_tag_of(nesting_names) : any_start_tag();
    if (tag == tags_.size() || !tags_[tag].counterpart || !one_in(4)) return;
    auto const before = part(tags_[tag].all);
    auto const after = part(tags_[std::max(tag, *tags_[tag].counterpart)].all);
    auto const times = one_in(2) ? any(5) : 50 + any(20);
    auto const element = element_of(tags_, tag);
    std::string all;
    for (std::size_t i = 0; i < times; ++i) all += before;
    all += part(element);
    for (std::size_t i = 0; i < times; ++i) all += after;
    put(element, all);
}

void Change::repeat_often() {
    auto const tag = any_start_tag();
    if (tag == tags_.size() || !one_in(8)) return;
    auto const element = element_of(tags_, tag);
    auto const copy = part(element);
    auto const times = one_in(10) && copy.size() < 60 ? 5'200 : any(60);
    std::string all;
    for (std::size_t i = 0; i < times; ++i) all += copy;
    put(element.end, all);
}

void Change::lengthen_a_name() {
    auto const tag = any_start_tag();
    if (tag == tags_.size()) return;
    std::string const prefix(one_in(2) ? 240 + any(20) : 1 + any(3), 'p');
    auto const name = part(tags_[tag].name);
    auto const colon = name.find(':');
    auto const local = colon == name.npos ? name : name.substr(colon + 1);
    auto const renamed = prefix + ":" + local;
    put(tags_[tag].name.end, " xmlns:" + prefix + "=\"" + std::string{any_of(namespaces)} + "\"");
    tags_ = tags_of(text_);
    rename(tag, renamed);
}

void Change::change_quotes() {
    auto const [tag, attribute] = any_attribute();
    if (tag == tags_.size()) return;
    auto const value = value_of(text_, attribute);
    auto const other = text_[attribute.end - 1] == '"' ? '\'' : '"';
    text_[value.begin - 1] = text_[value.end] = other;
}

// Long enough that the following text crosses the edge of a parser's buffer.
void Change::push_apart() {
    if (!one_in(4)) return;
    std::string all;
    auto const filling = any_of(fillings);
    for (auto const size = any(one_in(4) ? 60'000 : 9'000); all.size() < size;) all += filling;
    auto const list = any_start_tag_of(list_names);
    if (list != tags_.size() && one_in(3)) {
        put(tags_[list].all.end, all);
    } else {
        put(one_in(2) ? any_gap() : any_text().begin, all);
    }
}

void Change::declare_many_namespaces() {
    auto const tag = any_start_tag();
    if (tag == tags_.size() || !one_in(6)) return;
    std::string all;
    for (auto count = 20 + any(16); count > 0; --count) {
        all.append(" xmlns:n").append(std::to_string(count)).append("=\"").append(namespaces[3]).append("\"");
    }
    put(tags_[tag].name.end, all);
}

}  // namespace rois::fuzz
