// The tree of a message, as decoding reads it: elements with their attributes and texts, in document order.
#pragma once

#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace rois::xml {

// Names are local names: the schemas determine the namespace. Attributes exclude namespace declarations and those of xsi. Drops
// comments, and white space between elements. Texts are views of the document or of pugixml's tree, which must outlive their use.
// Keeps its memory for the next message. Not thread-safe.
class MessageTree {
public:
    class Node;  // one element, or none; valid until the tree is cleared
    class Children;

    Node root() const;
    std::string_view name_space() const { return name_space_; }  // the root's

    bool operator==(MessageTree const& other) const {
        return name_space_ == other.name_space_ && elements_ == other.elements_ && attributes_ == other.attributes_;
    }

    // Replaces the tree with that of pugixml's root. Returns false if elements are nested deeper than `deepest`.
    bool read(pugi::xml_node root, std::size_t deepest = std::numeric_limits<std::size_t>::max());

    // The functions below build the tree part by part, in document order: first the attributes of an element, then its content.
    void clear();
    void set_name_space(std::string_view name_space) { name_space_ = name_space; }
    void open(std::string_view name, std::string_view type);
    void add_attribute(std::string_view name, std::string_view value) {
        attributes_.push_back({name, value});
        ++elements_[innermost_].attributes.count;
    }
    void add_text(std::string_view);
    void close() { innermost_ = elements_[innermost_].parent; }

private:
    using Index = std::uint32_t;  // of an element; 0 is the root, and means "none" for a child
    struct Range {
        Index first = 0;
        Index count = 0;

        bool operator==(Range const&) const = default;
    };
    struct Attribute {
        std::string_view name;
        std::string_view value;

        bool operator==(Attribute const&) const = default;
    };
    struct Element {
        std::string_view name;
        std::string_view type;
        std::string_view text;
        Index parent = 0;
        Index next = 0;
        Index first_child = 0;
        Index last_child = 0;
        Range attributes;

        bool operator==(Element const&) const = default;
    };

    static Element const nothing;

    bool read_inside(pugi::xml_node, std::size_t deepest);
    void read_attribute(pugi::xml_node, pugi::xml_attribute);

    std::vector<Element> elements_;
    std::vector<Attribute> attributes_;
    std::map<Index, std::string> joined_;  // by element: texts made of several pieces
    std::string_view name_space_;
    Index innermost_ = 0;
};

class MessageTree::Node {
public:
    Node() = default;

    explicit operator bool() const { return tree_ != nullptr; }
    bool operator==(Node const&) const = default;

    // If the node refers to no element, its texts are empty and it has neither children nor attributes.
    std::string_view name() const { return element().name; }
    std::string_view type() const { return element().type; }  // the local name of its xsi:type; empty if it has none
    std::string_view text() const { return element().text; }
    Node first_child() const { return at(element().first_child); }
    Node next() const { return at(element().next); }
    Node child(std::string_view name) const;
    Children children() const;
    std::string child_text(std::string_view name) const { return std::string{child(name).text()}; }
    std::optional<std::string_view> attribute(std::string_view name) const;
    std::string attribute_text(std::string_view name) const { return std::string{attribute(name).value_or("")}; }

private:
    friend class MessageTree;
    Node(MessageTree const* tree, Index index) : tree_{tree}, index_{index} {}

    Element const& element() const { return tree_ == nullptr ? nothing : tree_->elements_[index_]; }
    Node at(Index index) const { return index == 0 ? Node{} : Node{tree_, index}; }

    MessageTree const* tree_ = nullptr;
    Index index_ = 0;
};

class MessageTree::Children {
public:
    class Iterator {
    public:
        using difference_type = std::ptrdiff_t;
        using value_type = Node;

        Iterator() = default;
        explicit Iterator(Node node) : node_{node} {}
        Node operator*() const { return node_; }
        Iterator& operator++() {
            node_ = node_.next();
            return *this;
        }
        Iterator operator++(int) {
            auto before = *this;
            ++*this;
            return before;
        }
        bool operator==(Iterator const&) const = default;

    private:
        Node node_;
    };

    explicit Children(Node first) : first_{first} {}
    Iterator begin() const { return Iterator{first_}; }
    Iterator end() const { return {}; }
    bool empty() const { return !first_; }
    Node front() const { return first_; }

private:
    Node first_;
};

inline MessageTree::Node MessageTree::root() const { return elements_.empty() ? Node{} : Node{this, 0}; }

inline MessageTree::Children MessageTree::Node::children() const { return Children{first_child()}; }

}  // namespace rois::xml
