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
    Document set(std::vector<Argument> const& arguments) { return guest.set_parameter(dial.component->ref, arguments); }

    Dial dial;
    Guest guest;
};

void set_parameter_completes_once_and_stores(Stage& stage) {
    Turning turning{stage};
    auto const id = ok(turning.set({turned(turning.dial, 41)})).text("command_id");
    require(!id.empty(), "set_parameter should answer with a command_id");
    same("the status of set_parameter", "OK", turning.guest.status_of(id));
    same(turning.dial.parameter, "41", turning.value());
    ok(turning.set({turned(turning.dial, 42)}));
    turning.guest.settle(*turning.dial.component);
    same(turning.dial.parameter, "42", turning.value());
    require(turning.guest.endings(id).size() == 1, "set_parameter completed more than once");
}

void execute_of_set_parameter_does_the_same(Stage& stage) {
    Turning turning{stage};
    same("the status", "OK",
         turning.guest.ending(
             {.component = turning.dial.component->ref, .type = "set_parameter", .arguments = {turned(turning.dial, 43)}}));
    same(turning.dial.parameter, "43", turning.value());
}

void parameters_are_named_ignoring_case(Stage& stage) {
    Turning turning{stage};
    ok(turning.set({{upper(turning.dial.parameter), "INT", {"44"}}}));
    same(turning.dial.parameter, "44", turning.value());
}

void data_types_may_be_urns(Stage& stage) {
    Turning turning{stage};
    ok(turning.set({{turning.dial.parameter, "urn:x-rois:def:DataType:ATR::Integer", {"49"}}}));
    same(turning.dial.parameter, "49", turning.value());
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
    if (!played) throw NotPlayed{"no free component has a value for what is spelt in two ways"};
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
                            name + " of " + component.ref + " has " + text + ", which is no code of ISO 639-1");
                    played = true;
                }
        }
    if (!played) throw NotPlayed{"no component tells languages"};
}

void bad_parameters_are_refused(Stage& stage) {
    Turning turning{stage};
    auto const& name = turning.dial.parameter;
    ok(turning.set({turned(turning.dial, 45)}));
    refused(turning.set({{"colour", "string", {"red"}}}), "BAD_PARAMETER", "colour");
    refused(turning.set({{name, "int", {"soon"}}}), "BAD_PARAMETER", name);
    refused(turning.set({{name, "int", {"46", "47"}}}), "BAD_PARAMETER", name);
    refused(turning.set({{name, "string", {"46"}}}), "BAD_PARAMETER", name);
    refused(turning.set({{name, "int", {"99999999999"}}}), "BAD_PARAMETER", name);
    refused(turning.set({turned(turning.dial, 46), {"colour", "string", {"red"}}}), "BAD_PARAMETER", "colour");
    same(name + " after what was refused", "45", turning.value());
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
    require(found != values.end() && found->second == std::vector<std::string>{"48"},
            "the query get_parameter does not tell that " + turning.dial.parameter + " is 48");
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
             {"parameters_are_read_without_a_binding_by_query", "decision 18", parameters_are_read_without_a_binding_by_query}}};
}

}  // namespace rois::conformance
