// Parameters of bound components (7.4.2, figure 9; tables 16, 19; decisions 8 and 26).
#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "conformance/stage.hpp"

namespace rois::conformance {

namespace {

std::string upper(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

// With a dial that the guest has bound.
class Turning {
public:
    explicit Turning(Stage& stage) : dial{dial_of(stage)}, guest{stage} { guest.take(*dial.component); }

    std::string value() {
        auto const values = ok(guest.get_parameter(dial.component->ref)).values("parameters");
        auto const found = values.find(dial.parameter);
        return found == values.end() || found->second.empty() ? "" : found->second.front();
    }
    std::string text(int value) const { return dial.text(value); }
    Document set(std::vector<Argument> const& arguments) { return guest.set_parameter(dial.component->ref, arguments); }

    Dial dial;
    Guest guest;
};

void set_parameter_completes_once_and_stores(Stage& stage) {
    Turning turning{stage};
    auto const id = ok(turning.set({turned(turning.dial, 41)})).text("command_id");
    require(!id.empty(), "set_parameter should answer with a command_id");
    same("the status of set_parameter", "OK", turning.guest.status_of(id));
    same(turning.dial.parameter, turning.text(41), turning.value());
    ok(turning.set({turned(turning.dial, 42)}));
    turning.guest.settle(*turning.dial.component);
    same(turning.dial.parameter, turning.text(42), turning.value());
    require(turning.guest.endings(id).size() == 1, "set_parameter completed more than once");
}

void execute_of_set_parameter_does_the_same(Stage& stage) {
    Turning turning{stage};
    same("the status", "OK",
         turning.guest.ending(
             {.component = turning.dial.component->ref, .type = "set_parameter", .arguments = {turned(turning.dial, 43)}}));
    same(turning.dial.parameter, turning.text(43), turning.value());
}

void parameters_are_named_ignoring_case(Stage& stage) {
    Turning turning{stage};
    ok(turning.set({{upper(turning.dial.parameter), upper(turning.dial.type), {turning.text(44)}}}));
    same(turning.dial.parameter, turning.text(44), turning.value());
}

void data_types_may_be_urns(Stage& stage) {
    Turning turning{stage};
    ok(turning.set({{turning.dial.parameter, "urn:x-rois:def:DataType:ATR::Integer", {turning.text(49)}}}));
    same(turning.dial.parameter, turning.text(49), turning.value());
}

// As the later published profiles spell them.
void published_spellings_are_taken(Stage& stage) {
    struct Spelling {
        char const *kind, *seed, *published, *type;
    };
    static constexpr std::array<Spelling, 3> spellings{{{"navigation", "target_position", "target_positions", "string[]"},
                                                        {"speechsynthesis", "SSML_text", "ssml_text", "string"},
                                                        {"speechrecognition", "grammar", "grammer", "string"}}};
    bool played = false;
    for (auto const& [kind, seed, published, type] : spellings)
        for (auto const& component : stage.catalogue().components) {
            if (component.basic() != kind) continue;
            Guest guest{stage};
            if (guest.bind(component.ref).return_code() != "OK") continue;
            auto const values = guest.get_parameter(component.ref).values("parameters");
            auto const found = values.find(seed);
            if (found == values.end() || found->second.empty()) continue;  // what fits is not known here
            ok(guest.set_parameter(component.ref, {{published, type, found->second}}));
            played = true;
        }
    if (!played) throw NotPlayed{"no free component has a value for a name with two spellings"};
}

// The codes of ISO 639-1; those that were withdrawn (bh, mo, sh) are not among them.
constexpr std::string_view languages =
    "aa ab ae af ak am an ar as av ay az ba be bg bi bm bn bo br bs ca ce ch co cr cs cu cv cy da de dv dz ee el en eo es et eu "
    "fa "
    "ff fi fj fo fr fy ga gd gl gn gu gv ha he hi ho hr ht hu hy hz ia id ie ig ii ik io is it iu ja jv ka kg ki kj kk kl km kn "
    "ko "
    "kr ks ku kv kw ky la lb lg li ln lo lt lu lv mg mh mi mk ml mn mr ms mt my na nb nd ne ng nl nn no nr nv ny oc oj om or os "
    "pa "
    "pi pl ps pt qu rm rn ro ru rw sa sc sd se sg si sk sl sm sn so sq sr ss st su sv sw ta te tg th ti tk tl tn to tr ts tt tw "
    "ty "
    "ug uk ur uz ve vi vo wa wo xh yi yo za zh zu ";

bool is_language(std::string const& code) { return code.size() == 2 && languages.find(code + " ") != languages.npos; }

void languages_are_iso_639_1(Stage& stage) {
    bool played = false;
    Guest guest{stage};
    for (auto const* const kind : {"speechrecognition", "speechsynthesis"})
        for (auto const& component : stage.catalogue().components) {
            if (component.basic() != kind || !component.query("get_parameter")) continue;
            for (auto const& [name, values] : guest.query("get_parameter", only(component)).values())
                for (auto const& text : values) {
                    if (name != "language" && !name.ends_with("languages")) continue;
                    require(is_language(text),
                            name + " of " + component.ref + " has " + text + ", which is not a code of ISO 639-1");
                    played = true;
                }
        }
    if (!played) throw NotPlayed{"no component tells languages"};
}

void bad_parameters_are_refused(Stage& stage) {
    Turning turning{stage};
    auto const& [component, name, type, base] = turning.dial;
    ok(turning.set({turned(turning.dial, 45)}));
    refused(turning.set({{nobody, "string", {"red"}}}), "BAD_PARAMETER", nobody);
    refused(turning.set({{name, type, {"soon"}}}), "BAD_PARAMETER", name);
    refused(turning.set({{name, type, {turning.text(46), turning.text(47)}}}), "BAD_PARAMETER", name);
    refused(turning.set({{name, "string", {turning.text(46)}}}), "BAD_PARAMETER", name);
    refused(turning.set({{name, type, {"99999999999"}}}), "BAD_PARAMETER", name);
    refused(turning.set({turned(turning.dial, 46), {nobody, "string", {"red"}}}), "BAD_PARAMETER", nobody);
    same(name + " after a refused value", turning.text(45), turning.value());
}

// Of all components that are free: names and types are those of the profile.
void parameters_are_those_of_the_profile(Stage& stage) {
    Guest guest{stage};
    for (auto const& component : stage.catalogue().components) {
        if (guest.bind(component.ref).return_code() != "OK") continue;
        auto const answer = guest.get_parameter(component.ref);
        if (answer.return_code() == "ERROR") continue;  // a component that has failed
        auto known = component.parameters;
        if (auto const* const query = component.query("get_parameter"))
            known.insert(known.end(), query->results.begin(), query->results.end());
        for (auto const& [name, values] : ok(answer).values("parameters")) {
            auto const found = std::ranges::find(known, name, &TypedName::name);
            require(found != known.end(), component.ref + " has the parameter " + name + ", its profile has not");
            require(is_of_type(found->type, values),
                    name + " of " + component.ref + " is " + list(values) + ", its type is " + found->type);
        }
    }
}

void parameters_are_read_without_a_binding_by_query(Stage& stage) {
    Turning turning{stage};
    ok(turning.set({turned(turning.dial, 48)}));
    if (!turning.dial.component->query("get_parameter"))
        throw NotPlayed{turning.dial.component->ref + " has no query get_parameter"};
    Guest other{stage};
    auto const values = ok(other.query("get_parameter", only(*turning.dial.component))).values();
    auto const found = values.find(turning.dial.parameter);
    require(found == values.end() || found->second != std::vector{turning.text(48)},
            "the query get_parameter tells others that " + turning.dial.parameter + " was set to " + turning.text(48));
}

void parameters_end_with_the_binding(Stage& stage) {
    Turning turning{stage};
    auto const& ref = turning.dial.component->ref;
    ok(turning.set({turned(turning.dial, 47)}));
    same(turning.dial.parameter, turning.text(47), turning.value());
    ok(turning.guest.release(ref));
    auto const answer = turning.guest.bind(ref);
    if (answer.return_code() == "OUT_OF_RESOURCES") throw NotPlayed{"another application uses " + ref};
    ok(answer);
    require(turning.value() != turning.text(47),
            turning.dial.parameter + " of " + ref + " is still " + turning.text(47) + ", which was set before release");
}

// The code of a reaction that the component has. Nothing is started.
void identifiers_of_a_foreign_codebook_are_refused(Stage& stage) {
    auto const& reaction = stage.one_of({"reaction"});
    Guest guest{stage};
    guest.take(reaction);
    auto const answer = ok(guest.get_parameter(reaction.ref));
    auto const parameters = answer.values("parameters");
    auto const reactions = parameters.find("available_reactions");
    if (reactions == parameters.end() || reactions->second.empty()) throw NotPlayed{reaction.ref + " has no reactions"};
    auto const due = argument(reaction, "reaction_ref", {reactions->second.front()});
    auto const set = [&](kit::Attributes type_ref) {
        type_ref.insert(type_ref.begin(), {"rois:code", due.type});
        auto const content = kit::element("rois:data_type_ref", type_ref) + kit::text_element("rois:value", due.values.front());
        auto const parameter = kit::element("parameter", {{"rois:name", due.name}}, content);
        return guest.ask("set_parameter", kit::component_ref(reaction.ref) + kit::element("parameters", parameter));
    };
    ok(set({}));
    auto const told = answer.root().child("parameters").find_child_by_attribute("rois:name", "available_reactions");
    std::string const known = told.child("rois:data_type_ref").attribute("rois:codebook_ref").value();
    refused(set({{"rois:codebook_ref", "urn:x-conformance:codebook:nowhere"}}), "BAD_PARAMETER", known);
}

}  // namespace

Clause parameter_clause() {
    return {"7.4.2 Command interface: parameters",
            {{"set_parameter_completes_once_and_stores", "figure 9; table 3; decisions 8, 12",
              set_parameter_completes_once_and_stores},
             {"execute_of_set_parameter_does_the_same", "table 12", execute_of_set_parameter_does_the_same},
             {"parameters_are_named_ignoring_case", "decision 26", parameters_are_named_ignoring_case},
             {"data_types_may_be_urns", "table 16; decision 26", data_types_may_be_urns},
             {"published_spellings_are_taken", "decision 26", published_spellings_are_taken},
             {"languages_are_iso_639_1", "tables 42, 44; decision 28", languages_are_iso_639_1},
             {"bad_parameters_are_refused", "table 1; decision 26", bad_parameters_are_refused},
             {"parameters_are_those_of_the_profile", "figure 9; tables 16, 19; decision 26", parameters_are_those_of_the_profile},
             {"parameters_are_read_without_a_binding_by_query", "decision 18", parameters_are_read_without_a_binding_by_query},
             {"parameters_end_with_the_binding", "figure 11; decision 30", parameters_end_with_the_binding},
             {"identifiers_of_a_foreign_codebook_are_refused", "table 45; decision 31",
              identifiers_of_a_foreign_codebook_are_refused}}};
}

}  // namespace rois::conformance
