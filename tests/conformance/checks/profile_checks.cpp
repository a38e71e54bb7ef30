// Profiles (7.4.1.1, figure 6; 7.5, tables 24 to 30) and errors (7.4.1.2, figure 7).
#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>

#include "conformance/stage.hpp"

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

// The gml:ids of the components' profiles, without what they begin with.
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

// Those of its sub engines, too.
std::vector<std::string> refs_of_engine(pugi::xml_node root) {
    std::set<std::string> refs;
    for (auto const component : root.select_nodes(".//rois:HRIComponent")) refs.insert(component.node().text().get());
    return {refs.begin(), refs.end()};
}

void get_profile_lists_all_components(Stage& stage) {
    Guest guest{stage};
    auto const answer = ok(guest.ask("get_profile"));
    auto const refs = refs_in(answer);
    require(!refs.empty(), "an engine has at least one component (table 30): " + answer.whole());
    require(std::set(refs.begin(), refs.end()).size() == refs.size(), "a component is listed twice: " + list(refs));
    auto const of_engine = refs_of_engine(answer.root());
    for (auto const& ref : of_engine)
        require(std::ranges::binary_search(refs, ref), "the engine's profile names " + ref + ", the list of components does not");
    for (auto const& ref : refs)
        require(std::ranges::binary_search(of_engine, ref),
                "the list of components names " + ref + ", the engine's profile does not");
}

void each_component_has_a_profile(Stage& stage) {
    Guest guest{stage};
    auto const answer = ok(guest.ask("get_profile"));
    for (auto const component : answer.root().child("components").children("component")) {
        std::string const ref = component.attribute("ref").value();
        auto const profile = profile_of(answer.root(), ref);
        require(static_cast<bool>(profile), "there is no HRIComponentProfile with the gml:id profile." + ref);
        same("the type of " + ref, component.attribute("type").value(), profile.child("gml:identifier").text().get());
    }
}

void get_profile_chooses_by_condition(Stage& stage) {
    Guest guest{stage};
    require(!stage.catalogue().components.empty(), "get_profile tells no component (table 30)");
    auto const& component = stage.catalogue().components.front();
    auto const answer = ok(guest.ask("get_profile", only(component)));
    auto const by_ref = refs_in(answer), profiles = profiles_in(answer);
    require(by_ref == std::vector{component.ref}, "only " + component.ref + " was asked for, but told are " + list(by_ref));
    require(profiles == by_ref, "only " + component.ref + " was asked for, but there are profiles of " + list(profiles));
    auto const by_type = refs_in(ok(guest.ask("get_profile", where(equal("component_type", component.type)))));
    require(std::ranges::binary_search(by_type, component.ref),
            component.ref + " is not among those of its type: " + list(by_type));
    require(refs_in(ok(guest.ask("get_profile", where(equal("component_ref", nobody))))).empty(),
            "no component was asked for, but components are returned");
}

void a_condition_that_cannot_be_read_is_refused(Stage& stage) {
    Guest guest{stage};
    auto const unknown = where(equal(nobody, "red"));
    refused(guest.ask("get_profile", unknown), "BAD_PARAMETER");
    refused(guest.ask("search", unknown), "BAD_PARAMETER");
    refused(guest.ask("bind_any", unknown), "BAD_PARAMETER");
    refused(guest.query("component_status", unknown), "BAD_PARAMETER");
}

// "rois:EventMessageProfileType person_detected": its messages and parameters, in order.
std::vector<std::string> contents_of(pugi::xml_node profile) {
    std::vector<std::string> contents;
    for (auto const child : profile.children())
        if (auto const name = child.attribute("rois:name"))
            contents.push_back(std::string{child.attribute("xsi:type").value()} + " " + name.value());
    return contents;
}

// Over the operation and as documents.
void profiles_are_served_as_documents(Stage& stage) {
    kit::HttpClient client{stage.address()};
    auto const engine = client.get("/rois/profile");
    require(engine.status == 200, "/rois/profile answers with " + std::to_string(engine.status));
    stage.traffic().validate(engine.body);
    same("the document at /rois/profile", "rois:HRIEngineProfile", engine.root().name());
    same("the components at /rois/profile", list(refs_of(stage.catalogue())), list(refs_of_engine(engine.root())));
    Guest guest{stage};
    auto const told = ok(guest.ask("get_profile"));
    for (auto const& ref : refs_of(stage.catalogue())) {
        auto const path = "/rois/profile/" + kit::path_segment(ref);
        auto const reply = client.get(path);
        require(reply.status == 200, path + " answers with " + std::to_string(reply.status));
        stage.traffic().validate(reply.body);
        same("the gml:id at " + path, "profile." + ref, named_by(reply.root().attribute("gml:id").value()));
        auto const profile = profile_of(told.root(), ref);
        same("the component at " + path, list(contents_of(profile)), list(contents_of(reply.root())));
    }
    same("the fault at a component that is not there", "not_found", client.get(std::string{"/rois/profile/"} + nobody).fault());
}

void documents_are_told_apart_by_etag(Stage& stage) {
    kit::HttpClient client{stage.address()};
    std::vector<std::string> paths{"/rois/profile"};
    for (auto const& ref : refs_of(stage.catalogue())) paths.push_back("/rois/profile/" + kit::path_segment(ref));
    for (auto const& path : paths) {
        auto const etag = client.get(path).header("ETag");
        require(!etag.empty(), path + " has no ETag");
        auto const again = client.get(path, {{"If-None-Match", etag}});
        require(again.status == 304,
                "the same ETag of " + path + " is answered with " + std::to_string(again.status) + " instead of 304");
    }
}

void profiles_name_data_types(Stage& stage) {
    for (auto const& component : stage.catalogue().components) {
        auto const named = [&](std::vector<TypedName> const& names) {
            for (auto const& one : names)
                require(!one.name.empty() && !one.type.empty(), "a parameter of " + component.ref + " has no name or no type");
        };
        named(component.parameters);
        for (auto const* const messages : {&component.commands, &component.queries, &component.events})
            for (auto const& message : *messages) {
                named(message.results);
                named(message.arguments);
            }
    }
}

// Of a list of texts, those between the white space.
std::vector<std::string> default_values(TypedName const& one) {
    if (!is_list_of_texts(one.type)) return {*one.default_value};
    std::istringstream words{*one.default_value};
    return {std::istream_iterator<std::string>{words}, {}};
}

void default_values_are_of_their_types(Stage& stage) {
    for (auto const& component : stage.catalogue().components) {
        auto const typed = [&](std::vector<TypedName> const& names) {
            for (auto const& one : names)
                if (one.default_value && !is_of_type(one.type, default_values(one)))
                    throw Broken{"the default value of " + one.name + " of " + component.ref + " is \"" + *one.default_value +
                                 "\", its type is " + one.type};
        };
        typed(component.parameters);
        for (auto const& command : component.commands) typed(command.arguments);
    }
}

void details_of_an_unknown_error_are_refused(Stage& stage) {
    Guest guest{stage};
    refused(guest.ask("get_error_detail", kit::text_element("error_id", nobody)), "BAD_PARAMETER");
}

}  // namespace

Clause profile_clause() {
    return {"7.5 Profiles; 7.4.1.2 System interface: errors",
            {{"get_profile_lists_all_components", "figure 6; tables 2, 30", get_profile_lists_all_components},
             {"each_component_has_a_profile", "tables 2, 29; decision 25", each_component_has_a_profile},
             {"get_profile_chooses_by_condition", "table 2; decision 18", get_profile_chooses_by_condition},
             {"a_condition_that_cannot_be_read_is_refused", "tables 2 to 4; decisions 4, 18",
              a_condition_that_cannot_be_read_is_refused},
             {"profiles_are_served_as_documents", "7.5; docs/clients.md", profiles_are_served_as_documents, Way::http},
             {"documents_are_told_apart_by_etag", "docs/clients.md", documents_are_told_apart_by_etag, Way::http},
             {"profiles_name_data_types", "tables 24 to 28", profiles_name_data_types, Way::http},
             {"default_values_are_of_their_types", "tables 16, 27; decision 26", default_values_are_of_their_types, Way::http},
             {"details_of_an_unknown_error_are_refused", "figure 7; table 2", details_of_an_unknown_error_are_refused}}};
}

}  // namespace rois::conformance
