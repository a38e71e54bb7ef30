#include "xml/profiles/profile_document.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

#include "xml/codec/place.hpp"
#include "xml/codec/tree.hpp"
#include "xml/profiles/profile_decoder.hpp"
#include "xml/profiles/profile_repair.hpp"
#include "xml/validation/checked_reader.hpp"
#include "xml/validation/explanation.hpp"
#include "xml/validation/grammars.hpp"

namespace rois::xml {

namespace {

BadDocument refusal(std::string const& name, Fault const& fault) {
    return BadDocument{at(name, fault.place.value_or(Place{})) + ": " + fault.reason};
}

// The tree of an invalid document after its repair.
class RepairedTree {
public:
    // Throws BadDocument: with `fault` if nothing could be repaired, or with the first error that remains.
    RepairedTree(std::shared_ptr<Schemas const> const& schemas, std::string const& name, std::string const& text,
                 Fault const& fault)
        : bytes_{text}, repairs_{repair_namespaces(bytes_, schemas->grammars().namespaces())} {
        tree_.load_buffer_inplace(bytes_.data(), bytes_.size(), as_xerces_reads, pugi::encoding_utf8);
        auto more = repair_profile(root());
        std::ranges::move(more, std::back_inserter(repairs_));
        std::ranges::stable_sort(repairs_, {}, &Repair::offset);
        if (repairs_.empty()) throw refusal(name, fault);
        if (auto const still = explain(*schemas, root(), {}))
            throw BadDocument{at(name, place_of(text, still->offset)) + ": " + still->reason};
        std::ostringstream again;
        tree_.save(again, "", pugi::format_raw, pugi::encoding_utf8);
        if (CheckedReader{schemas, {}}.read(again.str())) throw refusal(name, fault);
    }

    pugi::xml_node root() const { return tree_.document_element(); }

    std::vector<std::string> warnings(std::string const& name, std::string_view text) const {
        std::vector<std::string> all;
        all.reserve(repairs_.size());
        for (auto const& repair : repairs_) all.push_back(at(name, place_of(text, repair.offset)) + ": " + repair.warning);
        return all;
    }

private:
    std::string bytes_;
    std::vector<Repair> repairs_;
    pugi::xml_document tree_;
};

}  // namespace

ProfileDocument read_profile_document(std::shared_ptr<Schemas const> const& schemas, std::string const& name,
                                      std::string const& text) {
    CheckedReader reader{schemas, {}};
    auto const fault = reader.read(text);
    Places places{text};
    if (!fault) return decode_profile(reader.root(), name, places);
    if (fault->code != FaultCode::invalid) throw refusal(name, *fault);
    RepairedTree const repaired{schemas, name, text, *fault};
    auto document = decode_profile(repaired.root(), name, places);
    auto warnings = repaired.warnings(name, text);
    document.warnings.insert(document.warnings.begin(), warnings.begin(), warnings.end());
    return document;
}

ComponentProfile read_component_profile(std::shared_ptr<Schemas const> const& schemas, std::string const& name,
                                        std::string const& text) {
    auto document = read_profile_document(schemas, name, text);
    if (!document.warnings.empty()) throw BadDocument{document.warnings.front()};
    if (auto* const profile = std::get_if<ComponentProfile>(&document.profile)) return std::move(*profile);
    throw BadDocument{at(name, Place{}) + ": this is an engine profile: expected 'HRIComponentProfile'"};
}

std::vector<ComponentProfile> read_component_profiles(std::shared_ptr<Schemas const> const& schemas, NamedFiles const& files) {
    std::vector<ComponentProfile> profiles;
    for (auto const& [name, text] : files) profiles.push_back(read_component_profile(schemas, name, std::string{text}));
    return profiles;
}

}  // namespace rois::xml
