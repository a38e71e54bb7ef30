#include "fuzz/change.hpp"

#include "fuzz/pieces.hpp"

namespace rois::fuzz {

void Change::double_an_attribute() {
    auto const [tag, attribute] = any_attribute();
    if (tag == tags_.size()) return;
    auto copy = " " + part(attribute);
    if (auto const colon = copy.find(':'); colon != copy.npos && one_in(2))
        copy = " " + std::string{any_of(prefixes)} + copy.substr(colon + 1);
    put(attribute.end, copy);
}

void Change::delete_an_attribute() {
    auto const [tag, attribute] = any_attribute();
    if (tag != tags_.size()) put({attribute.begin - 1, attribute.end}, {});
}

void Change::move_an_attribute() {
    auto const [tag, attribute] = any_attribute();
    auto const target = any_start_tag();
    if (tag == tags_.size()) return;
    auto const moved = " " + part(attribute);
    if (target > tag) put(tags_[target].name.end, moved);
    if (!one_in(3)) put({attribute.begin - 1, attribute.end}, {});
    if (target < tag) put(tags_[target].name.end, moved);
}

void Change::add_an_attribute() {
    auto const tag = any_start_tag();
    if (tag == tags_.size()) return;
    std::string added{" "};
    if (one_in(2)) added += any_of(prefixes);
    added.append(any_of(attribute_names)).append("=\"").append(any_of(values)).append("\"");
    put(tags_[tag].name.end, added);
}

void Change::change_a_value() {
    auto const [tag, attribute] = any_attribute();
    if (tag == tags_.size()) return;
    auto const value = value_of(text_, attribute);
    if (one_in(3)) {
        put(value.begin + any(value.size() + 1), any_of(values));
    } else {
        put(value, any_of(values));
    }
}

void Change::change_a_text() {
    auto const range = any_text();
    if (range.end < range.begin) return;
    if (one_in(3)) {
        put(range.begin + any(range.size() + 1), any_of(values));
    } else {
        put(range, any_of(values));
    }
}

void Change::change_a_namespace() {
    auto const at = text_.find("xmlns", any(text_.size()));
    auto const quote = text_.find_first_of("\"'", at);
    if (at == text_.npos || quote == text_.npos) return;
    auto const end = text_.find(text_[quote], quote + 1);
    if (end != text_.npos) put({quote + 1, end}, any_of(namespaces));
}

void Change::declare_a_namespace() {
    auto const tag = any_start_tag();
    if (tag == tags_.size()) return;
    std::string const prefix{any_of(prefixes)};
    auto const name = prefix.size() < 2 ? std::string{"xmlns"} : "xmlns:" + prefix.substr(0, prefix.size() - 1);
    put(tags_[tag].name.end, " " + name + "='" + std::string{any_of(namespaces)} + "'");
}

void Change::change_a_type() {
    auto const written = text_.find("xsi:type=", any(text_.size()));
    auto const type = std::string{any_of(prefixes)}.append(any_of(type_names));
    if (written != text_.npos && !one_in(3)) {
        auto const quote = written + 9;
        auto const end = quote < text_.size() ? text_.find(text_[quote], quote + 1) : text_.npos;
        if (end != text_.npos) put({quote + 1, end}, type);
        return;
    }
    auto const tag = any_start_tag();
    if (tag != tags_.size()) put(tags_[tag].name.end, " xsi:type=\"" + type + "\"");
}

}  // namespace rois::fuzz
