#include "xml/tables/start_tag.hpp"

#include <array>

namespace rois::xml {

namespace {

// The bytes that end a name. The parser checks the characters of the name.
constexpr auto ends_name = bytes_of(" \t\r\n/>=<\"'&");

}  // namespace

StartTag::StartTag(std::string_view document, std::size_t offset) : document_{document}, at_{offset + 1} { name_ = take_name(); }

std::string_view StartTag::take_name() {
    auto const begin = at_;
    while (at_ < document_.size() && !ends_name[static_cast<unsigned char>(document_[at_])]) ++at_;
    return document_.substr(begin, at_ - begin);
}

void StartTag::skip_white_space() {
    while (at_ < document_.size() && white_space.find(document_[at_]) != white_space.npos) ++at_;
}

StartTag::Step StartTag::broken(std::string_view complaint) {
    complaint_ = at_ < document_.size() ? complaint : "the document ends inside a tag";
    return Step::broken;
}

StartTag::Step StartTag::next() {
    if (name_.empty()) return broken("'<' must be followed by the name of an element");
    skip_white_space();
    if (at_ == document_.size()) return broken({});
    if (document_[at_] == '>') {
        ++at_;
        return Step::end;
    }
    if (document_[at_] == '/') {
        ++at_;
        if (at_ == document_.size() || document_[at_] != '>') return broken("'/' inside a tag must be followed by '>'");
        ++at_;
        return Step::empty_end;
    }
    return take_attribute();
}

StartTag::Step StartTag::take_attribute() {
    attribute_ = take_name();
    if (attribute_.empty()) return broken("the name of an attribute is missing");
    skip_white_space();
    if (at_ == document_.size() || document_[at_] != '=') return broken("an attribute must have '=' and a value");
    ++at_;
    skip_white_space();
    if (at_ == document_.size() || (document_[at_] != '"' && document_[at_] != '\'')) {
        return broken("the value of an attribute must be in quotes");
    }
    auto const begin = at_ + 1;
    auto const end = document_.find(document_[at_], begin);
    auto const value = document_.substr(begin, end == document_.npos ? end : end - begin);
    if (auto const bracket = value.find('<'); bracket != value.npos) {
        at_ = begin + bracket;
        return broken("'<' inside the value of an attribute: write '&lt;'");
    }
    at_ = end == document_.npos ? document_.size() : end + 1;
    if (end == document_.npos) return broken({});
    value_ = value;
    return Step::attribute;
}

}  // namespace rois::xml
