// Profiles (7.4.1.1, figure 6; 7.5, tables 24 to 30) and errors (7.4.1.2, figure 7).
#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>

#include "conformance/context.hpp"

namespace rois::conformance {

namespace {

using kit::equal;
using kit::where;

std::vector<std::string> refs_in(Document const& profile) {
    std::vector<std::string> refs;
    for (auto const component : profile.root().child("components").children("component"))
        refs.emplace_back(component.attribute("ref").value());
    std::ranges::sort(refs);
    return refs;
}

std::vector<std::string> refs_of(Catalogue const& catalogue) {
    std::vector<std::string> refs;
    for (auto const& component : catalogue.components) refs.push_back(component.ref);
    return refs;
}

// Returns the refs in the gml:ids of the components' profiles.
std::vector<std::string> profiles_in(Document const& answer) {
    static std::string const begin = "profile.";
    std::vector<std::string> refs;
    for (auto const profile : answer.root().children("rois:HRIComponentProfile")) {
        auto const id = named_by(profile.attribute("gml:id").value());
        refs.push_back(id.starts_with(begin) ? id.substr(begin.size()) : id);
    }
    std::ranges::sort(refs);
    return refs;
}

// Returns the refs of the engine's components, including its sub engines.
std::vector<std::string> refs_of_engine(pugi::xml_node root) {
    std::set<std::string> refs;
    for (auto const component : root.select_nodes(".//rois:HRIComponent")) refs.insert(component.node().text().get());
    return {refs.begin(), refs.end()};
}

void get_profile_lists_all_components(Context& context) {
    Client client{context};
    auto const answer = require_ok(client.ask("get_profile"));
    auto const refs = refs_in(answer);
    require(!refs.empty(), "get_profile: expected at least one component (table 30), got " + answer.whole());
    require(std::set(refs.begin(), refs.end()).size() == refs.size(),
            "get_profile: expected each component once, got " + list(refs));
    auto const of_engine = refs_of_engine(answer.root());
    for (auto const& ref : of_engine)
        require(std::ranges::binary_search(refs, ref),
                "get_profile: the list of components lacks " + ref + ", which is in the engine's profile");
    for (auto const& ref : refs)
        require(std::ranges::binary_search(of_engine, ref),
                "get_profile: the engine's profile lacks " + ref + ", which is in the list of components");
}

void each_component_has_a_profile(Context& context) {
    Client client{context};
    auto const answer = require_ok(client.ask("get_profile"));
    for (auto const component : answer.root().child("components").children("component")) {
        std::string const ref = component.attribute("ref").value();
        auto const profile = profile_of(answer.root(), ref);
        require(static_cast<bool>(profile), "get_profile: expected an HRIComponentProfile with the gml:id profile." + ref);
        require_equal("the type of " + ref, component.attribute("type").value(), profile.child("gml:identifier").text().get());
    }
}

void a_condition_selects_profiles(Context& context) {
    Client client{context};
    require(!context.catalogue().components.empty(), "get_profile: expected at least one component (table 30)");
    auto const& component = context.catalogue().components.front();
    auto const answer = require_ok(client.ask("get_profile", only(component)));
    auto const by_ref = refs_in(answer), profiles = profiles_in(answer);
    require(by_ref == std::vector{component.ref},
            "get_profile with component_ref = " + component.ref + ": expected only this component, got " + list(by_ref));
    require(profiles == by_ref, "get_profile with component_ref = " + component.ref +
                                    ": expected only its profile, got profiles of " + list(profiles));
    auto const by_type = refs_in(require_ok(client.ask("get_profile", where(equal("component_type", component.type)))));
    require(std::ranges::binary_search(by_type, component.ref),
            "get_profile with component_type = " + component.type + ": expected " + component.ref + ", got " + list(by_type));
    require(refs_in(require_ok(client.ask("get_profile", where(equal("component_ref", unknown_name))))).empty(),
            "get_profile with an unknown component_ref: expected no components");
}

void a_condition_with_an_unknown_reference_is_refused(Context& context) {
    Client client{context};
    auto const unknown = where(equal(unknown_name, "red"));
    require_refusal(client.ask("get_profile", unknown), "BAD_PARAMETER");
    require_refusal(client.ask("search", unknown), "BAD_PARAMETER");
    require_refusal(client.ask("bind_any", unknown), "BAD_PARAMETER");
    require_refusal(client.query("component_status", unknown), "BAD_PARAMETER");
}

// Returns the types and names of the messages and parameters of a profile, in order: "rois:EventMessageProfileType
// person_detected".
std::vector<std::string> contents_of(pugi::xml_node profile) {
    std::vector<std::string> contents;
    for (auto const child : profile.children())
        if (auto const name = child.attribute("rois:name"))
            contents.push_back(std::string{child.attribute("xsi:type").value()} + " " + name.value());
    return contents;
}

// Compares the documents at /rois/profile with the answer of get_profile.
void profiles_are_served_as_documents(Context& context) {
    kit::HttpClient http{context.address()};
    auto const engine = http.get("/rois/profile");
    require(engine.status == 200, "GET /rois/profile: expected status 200, got " + std::to_string(engine.status));
    context.traffic().validate(engine.body);
    require_equal("the document at /rois/profile", "rois:HRIEngineProfile", engine.root().name());
    require_equal("the components at /rois/profile", list(refs_of(context.catalogue())), list(refs_of_engine(engine.root())));
    Client client{context};
    auto const answer = require_ok(client.ask("get_profile"));
    for (auto const& ref : refs_of(context.catalogue())) {
        auto const path = "/rois/profile/" + kit::path_segment(ref);
        auto const reply = http.get(path);
        require(reply.status == 200, "GET " + path + ": expected status 200, got " + std::to_string(reply.status));
        context.traffic().validate(reply.body);
        require_equal("the gml:id at " + path, "profile." + ref, named_by(reply.root().attribute("gml:id").value()));
        auto const profile = profile_of(answer.root(), ref);
        require_equal("the component at " + path, list(contents_of(profile)), list(contents_of(reply.root())));
    }
    require_equal("the fault for an unknown component", "not_found",
                  http.get(std::string{"/rois/profile/"} + unknown_name).fault());
}

void profile_documents_have_etags(Context& context) {
    kit::HttpClient http{context.address()};
    std::vector<std::string> paths{"/rois/profile"};
    for (auto const& ref : refs_of(context.catalogue())) paths.push_back("/rois/profile/" + kit::path_segment(ref));
    for (auto const& path : paths) {
        auto const etag = http.get(path).header("ETag");
        require(!etag.empty(), "GET " + path + ": expected a header ETag");
        auto const again = http.get(path, {{"If-None-Match", etag}});
        require(again.status == 304,
                "GET " + path + " with If-None-Match: expected status 304, got " + std::to_string(again.status));
    }
}

void parameters_have_names_and_types(Context& context) {
    for (auto const& component : context.catalogue().components) {
        auto const named = [&](std::vector<TypedName> const& names) {
            for (auto const& one : names)
                require(
                    !one.name.empty() && !one.type.empty(),
                    "the profile of " + component.ref + ": expected a name and a type for each parameter, result and argument");
        };
        named(component.parameters);
        for (auto const* const messages : {&component.commands, &component.queries, &component.events})
            for (auto const& message : *messages) {
                named(message.results);
                named(message.arguments);
            }
    }
}

// Returns the values in a default value: a list of texts is separated by white space.
std::vector<std::string> default_values(TypedName const& one) {
    if (!is_list_of_texts(one.type)) return {*one.default_value};
    std::istringstream words{*one.default_value};
    return {std::istream_iterator<std::string>{words}, {}};
}

void default_values_match_their_types(Context& context) {
    for (auto const& component : context.catalogue().components) {
        auto const typed = [&](std::vector<TypedName> const& names) {
            for (auto const& one : names)
                if (one.default_value && !is_of_type(one.type, default_values(one)))
                    throw Broken{"the default value of " + one.name + " of " + component.ref + ": \"" + *one.default_value +
                                 "\" is not valid: expected the type " + one.type};
        };
        typed(component.parameters);
        for (auto const& command : component.commands) typed(command.arguments);
    }
}

void details_of_an_unknown_error_are_refused(Context& context) {
    Client client{context};
    require_refusal(client.ask("get_error_detail", kit::text_element("error_id", unknown_name)), "BAD_PARAMETER");
}

}  // namespace

Clause profile_clause() {
    return {
        "7.5 Profiles; 7.4.1.2 System interface: errors",
        {{"get_profile_lists_all_components", "figure 6; tables 2, 30", get_profile_lists_all_components},
         {"each_component_has_a_profile", "tables 2, 29; decision 25", each_component_has_a_profile},
         {"a_condition_selects_profiles", "table 2; decision 18", a_condition_selects_profiles},
         {"a_condition_with_an_unknown_reference_is_refused", "tables 2 to 4; decisions 4, 18",
          a_condition_with_an_unknown_reference_is_refused},
         {"profiles_are_served_as_documents", "7.5; docs/clients.md", profiles_are_served_as_documents, Transport::http},
         {"profile_documents_have_etags", "docs/clients.md", profile_documents_have_etags, Transport::http},
         {"parameters_have_names_and_types", "tables 24 to 28", parameters_have_names_and_types, Transport::http},
         {"default_values_match_their_types", "tables 16, 27; decision 26", default_values_match_their_types, Transport::http},
         {"details_of_an_unknown_error_are_refused", "figure 7; table 2", details_of_an_unknown_error_are_refused}}};
}

}  // namespace rois::conformance
