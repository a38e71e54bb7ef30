#include "basic/speech/ssml.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "basic/speech/languages.hpp"
#include "basic/speech/ssml_meaning.hpp"
#include "types/text/texts.hpp"
#include "xml/profiles/document.hpp"

namespace rois::basic {
namespace {

constexpr std::string_view ssml_namespace = "http://www.w3.org/2001/10/synthesis";
constexpr std::string_view xml_namespace = "http://www.w3.org/XML/1998/namespace";

BadSsml bad(rois::Place place, std::string const& reason) {
    return {"line " + std::to_string(place.line) + ", column " + std::to_string(place.column) + ": " + reason};
}

// Walks through the document.
class SsmlWalk {
public:
    SsmlWalk(xml::Element const& root, std::string_view character) : root_namespace_{root.name_space()}, meaning_{character} {
        element(root);
    }

    std::variant<SpokenText, BadSsml> outcome() const {
        if (flaw_) return *flaw_;
        return SpokenText{meaning_.passages()};
    }

private:
    void element(xml::Element const& element) {
        bool const is_ours = element.name_space() == root_namespace_ || element.name_space() == ssml_namespace;
        if (auto const language = meaning_.begin(is_ours ? element.name() : std::string_view{}, attributes(element, is_ours))) {
            flaw_ = bad(element.place(),
                        "the language " + quoted(*language) + " cannot be synthesized; expected one of " + names_of_languages());
            return;
        }
        for (auto const& part : element.content()) {
            if (flaw_) return;
            if (auto const* text = std::get_if<std::string>(&part)) {
                meaning_.say(*text);
            } else {
                this->element(std::get<xml::Element>(part));
            }
        }
        meaning_.end();
    }

    static std::vector<SsmlAttribute> attributes(xml::Element const& element, bool is_ours) {
        std::vector<SsmlAttribute> found;
        for (auto& attribute : element.attributes()) {
            if (attribute.name_space.empty() && is_ours) found.push_back({attribute.name, std::move(attribute.value)});
            if (attribute.name_space == xml_namespace && attribute.name == "lang")
                found.push_back({"xml:lang", std::move(attribute.value)});
        }
        return found;
    }

    std::string_view root_namespace_;  // SSML's or none
    SsmlMeaning meaning_;
    std::optional<BadSsml> flaw_;
};

}  // namespace

std::variant<SpokenText, BadSsml> read_ssml(std::string_view document, std::string_view character) {
    auto const read = xml::Document::read_well_formed(std::string{document});
    if (auto const* fault = std::get_if<rois::Fault>(&read)) return bad(fault->place.value_or(rois::Place{}), fault->reason);
    auto const root = std::get<xml::Document>(read).root();
    bool const is_of_ssml = root.name_space().empty() || root.name_space() == ssml_namespace;
    if (root.name() != "speak" || !is_of_ssml) {
        auto const of = root.name_space().empty() ? "" : " of the namespace " + quoted(root.name_space());
        return bad(root.place(), "the root element is " + quoted(root.name()) + of + ", not SSML's 'speak'");
    }
    return SsmlWalk{root, character}.outcome();
}

}  // namespace rois::basic
