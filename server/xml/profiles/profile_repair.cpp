#include "xml/profiles/profile_repair.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <variant>

#include "types/text/texts.hpp"
#include "xml/codec/encoding.hpp"
#include "xml/codec/names.hpp"
#include "xml/codec/tree.hpp"
#include "xml/validation/explanation.hpp"
#include "xml/validation/scan.hpp"

namespace rois::xml {

namespace {

constexpr std::string_view any_rois_namespace = "http://www.omg.org/spec/RoIS/";  // followed by a date

bool is_rois_of_another_date(std::string_view name) {
    auto const is_digit = [](char c) { return c >= '0' && c <= '9'; };
    return name.size() == rois_namespace.size() && name.starts_with(any_rois_namespace) &&
           std::ranges::all_of(name.substr(any_rois_namespace.size()), is_digit);
}

// The kinds of messages in the spellings of documents. The published text misspells one ("Commane").
struct KindOfMessage {
    std::string_view written;
    std::string_view type;
};
constexpr std::array<KindOfMessage, 7> kinds{{{"CommandMessageProfileType", "CommandMessageProfileType"},
                                              {"CommaneMessageProfileType", "CommandMessageProfileType"},
                                              {"QueryMessageProfileType", "QueryMessageProfileType"},
                                              {"EventMessageProfileType", "EventMessageProfileType"},
                                              {"CommandMessageProfile", "CommandMessageProfileType"},
                                              {"QueryMessageProfile", "QueryMessageProfileType"},
                                              {"EventMessageProfile", "EventMessageProfileType"}}};

std::string without_underscores(std::string_view name) {
    std::string without{name};
    std::erase(without, '_');
    return without;
}

std::string_view type_meant(std::string_view written) {
    auto const name = without_underscores(written);
    auto const found = std::ranges::find_if(kinds, [&](auto const& kind) { return equal_ignoring_case(kind.written, name); });
    return found == kinds.end() ? std::string_view{} : found->type;
}

// The parts of profiles: their names in the tables of 2011 (24 to 30), and in the XML (decision 29). The names of the profiles
// themselves differ only by underscores.
struct Renamed {
    std::string_view old;
    std::string_view name;
};
constexpr std::array<Renamed, 3> parts_of_components{
    {{"sub_component", "SubComponentProfile"}, {"message", "MessageProfile"}, {"parameter", "ParameterProfile"}}};
constexpr std::array<Renamed, 3> parts_of_engines{
    {{"sub_profile", "SubProfile"}, {"component", "HRIComponent"}, {"parameter", "ParameterProfile"}}};
constexpr std::array<Renamed, 3> parts_of_messages{
    {{"results", "Results"}, {"argument", "Arguments"}, {"arguments", "Arguments"}}};
constexpr std::array<std::string_view, 7> names_of_profiles{"HRIComponentProfile", "HRIEngineProfile",      "ParameterProfile",
                                                            "MessageProfile",      "CommandMessageProfile", "QueryMessageProfile",
                                                            "EventMessageProfile"};

using Order = std::vector<std::string_view>;

Order const object_first{"metaDataProperty", "description", "descriptionReference", "identifier", "name", "remarks"};

Order after_object(std::initializer_list<std::string_view> names) {
    auto order = object_first;
    order.insert(order.end(), names);
    return order;
}

class ProfileRepair {
public:
    explicit ProfileRepair(pugi::xml_node root) : root_{root} {}

    std::vector<Repair> run() {
        rois_ = prefix_for(rois_namespace, "rois");
        rename(root_, {});
        auto const name = local_name(root_);
        if (name == "HRIComponentProfile") component(root_);
        if (name == "HRIEngineProfile") engine(root_);
        return std::move(repairs_);
    }

private:
    void note(pugi::xml_node element, std::string warning) { repairs_.push_back({offset_of(element), std::move(warning)}); }

    // Replaces an element's name of 2011 by its name in the schemas.
    void rename(pugi::xml_node element, std::span<Renamed const> parts) {
        auto const name = local_name(element);
        auto const part = std::ranges::find(parts, name, &Renamed::old);
        auto const profile = std::ranges::find(names_of_profiles, without_underscores(name));
        auto const today = part != parts.end() ? part->name : profile != names_of_profiles.end() ? *profile : std::string_view{};
        if (today.empty() || today == name) return;
        note(element, quoted(element.name()) + " is a name of 2011: read as " + quoted(today));
        element.set_name((rois_prefix_of(element) + std::string{today}).c_str());
    }

    // Returns a prefix for the namespace, and declares it at the root if there is none. Attributes need a prefix.
    std::string prefix_for(std::string_view name_space, std::string wanted) {
        for (auto const each : root_.attributes())
            if (std::string_view{each.name()}.starts_with("xmlns:") && each.value() == name_space)
                return std::string{local_part(each.name())};
        while (root_.attribute(("xmlns:" + wanted).c_str())) wanted += '_';
        root_.append_attribute(("xmlns:" + wanted).c_str()).set_value(std::string{name_space}.c_str());
        return wanted;
    }

    std::string rois(std::string_view name) const { return rois_ + ":" + std::string{name}; }

    void component(pugi::xml_node profile) {
        object(profile);
        std::vector<pugi::xml_node> const children{profile.children().begin(), profile.children().end()};
        for (auto const child : children) {
            rename(child, parts_of_components);
            auto const name = local_name(child);
            if (name == "ParameterProfile") parameter(child);
            if (name == "MessageProfile" || name.ends_with("MessageProfile")) message(child);
        }
        put_in_order(profile, after_object({"SubComponentProfile", "MessageProfile", "ParameterProfile"}));
    }

    void engine(pugi::xml_node profile) {
        object(profile);
        for (auto const child : profile.children()) {
            rename(child, parts_of_engines);
            if (local_name(child) == "ParameterProfile") parameter(child);
            if (local_name(child) == "SubProfile") engine(child);
        }
        put_in_order(profile, after_object({"SubProfile", "HRIComponent", "ParameterProfile"}));
    }

    // Returns the element's prefix with its colon ("rois:"), or an empty text.
    static std::string rois_prefix_of(pugi::xml_node element) {
        auto const prefix = prefix_of(element.name());
        return prefix.empty() ? std::string{} : std::string{prefix} + ":";
    }

    // Repairs gml:id and the code space of the identifier.
    void object(pugi::xml_node profile) {
        auto const gml_id = prefix_for(gml_namespace, "gml") + ":id";
        if (auto bare = profile.attribute("id"); bare && !profile.attribute(gml_id.c_str())) {
            note(profile, "the attribute 'id' has no prefix: read as 'gml:id'");
            bare.set_name(gml_id.c_str());
        }
        auto id = profile.attribute(gml_id.c_str());
        if (!id) {
            note(profile, quoted(profile.name()) + " has no 'gml:id': added one");
            id = profile.append_attribute(gml_id.c_str());
            id.set_value("profile");
        }
        auto fit = is_nc_name(trimmed(id.value())) ? std::string{trimmed(id.value())} : nc_name(trimmed(id.value()));
        if (fit != trimmed(id.value()))
            note(profile, "the 'gml:id' " + quoted(id.value()) + " is not a valid XML name: read as " + quoted(fit));
        while (!ids_.insert(fit).second) fit += '_';
        id.set_value(fit.c_str());
        if (auto identifier = child(profile, "identifier"); identifier && !attribute(identifier, "codeSpace")) {
            note(identifier, "the identifier has no 'codeSpace': read as urn:ietf:rfc:2141");
            identifier.append_attribute("codeSpace").set_value("urn:ietf:rfc:2141");
        }
    }

    void parameter(pugi::xml_node element) {
        add_prefixes(element, {"name", "default_value", "description"});
        for (auto const type : element.children())
            if (local_name(type) == "data_type_ref") add_prefixes(type, {"code", "authority", "codebook_ref", "version"});
    }

    void message(pugi::xml_node element) {
        add_prefixes(element, {"name", "timeout"});
        auto const type = message_type(element);
        std::vector<pugi::xml_node> const children{element.children().begin(), element.children().end()};
        for (auto child : children) {
            rename(child, parts_of_messages);
            auto const name = local_name(child);
            if (name == "Results" || name == "Arguments") parameter(child);
            if (name != "Arguments") continue;
            if (type == "EventMessageProfileType") {
                note(child, "an event has no arguments: 'Arguments' are read as 'Results'");
                child.set_name((rois_prefix_of(child) + "Results").c_str());
            } else if (type == "QueryMessageProfileType") {
                note(child, "a query has a condition and no arguments: 'Arguments' are ignored");
                element.remove_child(child);
            }
        }
        if (type == "CommandMessageProfileType") put_in_order(element, {"Results", "Arguments"});
    }

    // Writes the kind of message into its xsi:type and returns it; empty if it is unknown.
    std::string_view message_type(pugi::xml_node element) {
        auto const said = xsi_type(element);
        auto const name = local_name(element);
        auto const type = type_meant(said ? said->local_name : name);
        if (type.empty()) return {};
        if (said && (said->name_space != rois_namespace || said->local_name != type)) {
            auto written = xsi_attribute(element, "type");
            note(element, "the xsi:type " + quoted(written.value()) + " is read as " + quoted(rois(type)));
            written.set_value(rois(type).c_str());
        }
        if (!said) element.append_attribute((prefix_for(xsi_namespace, "xsi") + ":type").c_str()).set_value(rois(type).c_str());
        if (name != "MessageProfile") {
            note(element, quoted(element.name()) + " is read as 'MessageProfile' with the xsi:type " + quoted(rois(type)));
            element.set_name((rois_prefix_of(element) + "MessageProfile").c_str());
        }
        return type;
    }

    void add_prefixes(pugi::xml_node element, std::initializer_list<std::string_view> names) {
        for (auto const name : names) {
            auto bare = element.attribute(std::string{name}.c_str());
            if (!bare || element.attribute(rois(name).c_str())) continue;
            note(element, "the attribute " + quoted(name) + " has no prefix: read as " + quoted(rois(name)));
            bare.set_name(rois(name).c_str());
        }
    }

    // Sorts the children into this order, if necessary. Keeps the order of children with the same name.
    void put_in_order(pugi::xml_node parent, Order const& order) {
        auto const rank = [&](pugi::xml_node node) { return std::ranges::find(order, local_name(node)) - order.begin(); };
        std::vector<pugi::xml_node> elements;
        for (auto const child : parent.children())
            if (child.type() == pugi::node_element) elements.push_back(child);
        auto const before = std::ranges::adjacent_find(elements, [&](auto a, auto b) { return rank(b) < rank(a); });
        if (before == elements.end()) return;
        // an element that a repair has added has no offset
        if (auto const late = *std::next(before); late.offset_debug() >= 0)
            note(late, quoted(late.name()) + " after " + quoted(before->name()) + ": read in any order");
        std::ranges::stable_sort(elements, {}, rank);
        for (auto const element : elements) parent.append_move(element);
    }

    pugi::xml_node root_;
    std::string rois_;
    std::set<std::string> ids_;
    std::vector<Repair> repairs_;
};

}  // namespace

std::vector<Repair> repair_namespaces(std::span<char> document, std::span<std::string const> known) {
    std::vector<Repair> repairs;
    DocumentLimits const limits;
    while (true) {
        auto const outcome = scan(document, limits, known);
        auto const* scanned = std::get_if<Scanned>(&outcome);
        if (scanned == nullptr || !scanned->foreign) return repairs;
        auto const [written, offset] = *scanned->foreign;
        auto const name = trimmed(written);
        bool const dated = is_rois_of_another_date(name);
        bool const spaced = name.size() < written.size() && (dated || std::ranges::find(known, name) != known.end());
        if (!dated && !spaced) return repairs;
        auto* const begin = document.data() + (written.data() - document.data());
        if (spaced) {
            // Moves the quotes inwards, so that the white space is outside of the value.
            repairs.push_back({offset, "the namespace " + quoted(written) + " has white space around it, which is ignored"});
            char const quote = begin[-1];
            std::string moved(static_cast<std::size_t>(name.data() - written.data()), ' ');
            moved.append(1, quote).append(name).append(1, quote).append(written.size() + 2 - moved.size(), ' ');
            std::ranges::copy(moved, begin - 1);
        } else {
            repairs.push_back({offset, "the namespace " + quoted(written) + " is read as " + quoted(rois_namespace)});
            std::ranges::copy(rois_namespace, begin);
        }
    }
}

std::vector<Repair> repair_profile(pugi::xml_node root) { return ProfileRepair{root}.run(); }

}  // namespace rois::xml
