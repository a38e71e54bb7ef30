#include "fuzz/markup.hpp"

#include <algorithm>

namespace rois::fuzz {

namespace {

constexpr std::string_view white_space = " \t\r\n";

std::size_t or_end(std::size_t found, std::string_view text) { return std::min(found, text.size()); }

std::vector<Range> attributes_of(std::string_view text, std::size_t from, std::size_t end) {
    std::vector<Range> attributes;
    while ((from = or_end(text.find_first_not_of(white_space, from), text)) < end) {
        auto const equals = text.find('=', from);
        if (equals >= end || equals + 1 >= end) break;
        auto const open = or_end(text.find_first_of("\"'", equals), text);
        if (open >= end) break;
        auto const close = or_end(text.find(text[open], open + 1), text);
        if (close >= end) break;
        attributes.push_back({from, close + 1});
        from = close + 1;
    }
    return attributes;
}

}  // namespace

std::vector<Tag> tags_of(std::string_view document) {
    std::vector<Tag> tags;
    std::vector<std::size_t> open;
    for (auto at = document.find('<'); at < document.size(); at = document.find('<', at + 1)) {
        auto const next = at + 1 < document.size() ? document[at + 1] : '\0';
        auto const end = document.find('>', at);
        if (next == '?' || next == '!' || end == document.npos) continue;
        Tag tag;
        tag.kind = next == '/' ? Tag::Kind::end : document[end - 1] == '/' ? Tag::Kind::empty : Tag::Kind::start;
        tag.all = {at, end + 1};
        auto const name = at + (tag.kind == Tag::Kind::end ? 2 : 1);
        tag.name = {name, std::max(name, or_end(document.find_first_of(" \t\r\n/>", name), document))};
        if (tag.kind != Tag::Kind::end) tag.attributes = attributes_of(document, tag.name.end, end);
        if (tag.kind == Tag::Kind::start) open.push_back(tags.size());
        if (tag.kind == Tag::Kind::end && !open.empty()) {
            tag.counterpart = open.back();
            tags[open.back()].counterpart = tags.size();
            open.pop_back();
        }
        tags.push_back(std::move(tag));
    }
    return tags;
}

Range element_of(std::vector<Tag> const& tags, std::size_t start_tag) {
    auto const& tag = tags[start_tag];
    return {tag.all.begin, tag.counterpart ? tags[std::max(start_tag, *tag.counterpart)].all.end : tag.all.end};
}

Range value_of(std::string_view document, Range attribute) {
    auto const quote = document[attribute.end - 1];
    return {document.find(quote, attribute.begin) + 1, attribute.end - 1};
}

}  // namespace rois::fuzz
