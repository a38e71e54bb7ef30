#include "xml/codec/message_tree.hpp"

#include "types/text/texts.hpp"
#include "xml/codec/names.hpp"
#include "xml/codec/tree.hpp"

namespace rois::xml {

namespace {

constexpr std::size_t keep_at_most = 1024;  // elements, and attributes, for which memory is kept between messages

template <class T>
void clear(std::vector<T>& list) {
    list.clear();
    if (list.capacity() > keep_at_most) list.shrink_to_fit();
}

bool is_white_space(std::string_view text) { return text.find_first_not_of(" \t\r\n") == text.npos; }

}  // namespace

void MessageTree::clear() {
    xml::clear(elements_);
    xml::clear(attributes_);
    joined_.clear();
    name_space_ = {};
    innermost_ = 0;
}

void MessageTree::open(std::string_view name, std::string_view type) {
    auto const index = static_cast<Index>(elements_.size());
    if (index > 0) {
        auto& parent = elements_[innermost_];
        if (!parent.text.empty() && is_white_space(parent.text)) parent.text = {};
        if (parent.first_child == 0) {
            parent.first_child = index;
        } else {
            elements_[parent.last_child].next = index;
        }
        parent.last_child = index;
    }
    elements_.push_back({.name = name,
                         .type = type,
                         .text = {},
                         .parent = innermost_,
                         .attributes = {.first = static_cast<Index>(attributes_.size())}});
    innermost_ = index;
}

void MessageTree::add_text(std::string_view piece) {
    auto& element = elements_[innermost_];
    if (element.first_child != 0 && is_white_space(piece)) return;
    if (element.text.empty()) {
        element.text = piece;
    } else {
        auto& joined = joined_[innermost_];
        if (joined.data() != element.text.data()) joined.assign(element.text);  // it is the second piece
        element.text = joined.append(piece);
    }
}

bool MessageTree::read(pugi::xml_node root, std::size_t deepest) {
    clear();
    name_space_ = namespace_of(root, prefix_of(root.name()));
    return read_inside(root, deepest);
}

bool MessageTree::read_inside(pugi::xml_node node, std::size_t deepest) {
    if (deepest == 0) return false;
    open(local_name(node), {});
    for (auto each = node.first_attribute(); each; each = each.next_attribute()) read_attribute(node, each);
    for (auto each = node.first_child(); each; each = each.next_sibling()) {
        auto const type = each.type();
        if (type == pugi::node_element && !read_inside(each, deepest - 1)) return false;
        if (type == pugi::node_pcdata || type == pugi::node_cdata) add_text(each.value());
    }
    close();
    return true;
}

void MessageTree::read_attribute(pugi::xml_node node, pugi::xml_attribute attribute) {
    std::string_view const name = attribute.name();
    auto const colon = name.find(':');
    auto const prefix = name.substr(0, colon == name.npos ? 0 : colon);
    auto const local = name.substr(prefix.empty() ? 0 : colon + 1);
    if (declares_namespace(name)) return;
    if (!is_of_xsi(node, prefix, local)) {
        add_attribute(local, attribute.value());
    } else if (local == "type") {
        elements_[innermost_].type = local_part(trimmed(attribute.value()));
    }
}

constinit MessageTree::Element const MessageTree::nothing;

MessageTree::Node MessageTree::Node::child(std::string_view name) const {
    for (auto const each : children()) {
        if (each.name() == name) return each;
    }
    return {};
}

std::optional<std::string_view> MessageTree::Node::attribute(std::string_view name) const {
    auto const& [first, count] = element().attributes;
    for (auto i = first; i < first + count; ++i) {
        if (tree_->attributes_[i].name == name) return tree_->attributes_[i].value;
    }
    return std::nullopt;
}

}  // namespace rois::xml
