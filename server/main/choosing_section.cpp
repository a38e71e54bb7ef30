#include "main/choosing_section.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "main/configuration_file.hpp"
#include "main/json_file.hpp"
#include "main/settings.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

using nlohmann::json;

constexpr std::string_view expected_key =
    "expected \"engines\" (names of sub engines), \"logical\" and \"sensing\" (names of components, at least one of the two) "
    "and, if wanted, \"areas\" and \"low_battery\"";

bool is_list_of_names(json const& value) {
    auto const is_name = [](json const& each) { return each.is_string() && !each.get_ref<std::string const&>().empty(); };
    if (!value.is_array() || value.empty() || !std::ranges::all_of(value, is_name)) return false;
    auto const names = value.get<std::vector<std::string>>();
    return std::set<std::string>{names.begin(), names.end()}.size() == names.size();
}

// The components of RoIS of each kind. Others may have any name.
constexpr std::array<std::string_view, 7> acting{"navigation",      "move",           "follow", "speech_synthesis", "reaction",
                                                 "audio_streaming", "video_streaming"};
constexpr std::array<std::string_view, 9> sensing{"person_detection",   "person_localization", "person_identification",
                                                  "face_detection",     "face_localization",   "sound_detection",
                                                  "sound_localization", "speech_recognition",  "gesture_recognition"};

// Returns why a component cannot be in this list, or an empty text.
std::string why_not_in(std::string_view list, std::string const& name) {
    auto const is_in = [&](auto const& names) { return std::ranges::find(names, name) != names.end(); };
    if (name == "system_information") return "cannot be logical: a query without a condition joins the answers of all engines";
    if (list == "logical" && is_in(sensing)) return "senses: it belongs to \"sensing\"";
    if (list == "sensing" && is_in(acting)) return "acts: it belongs to \"logical\"";
    return {};
}

// In mm^2, by the shoelace formula.
double surface(choosing::Area const& corners) {
    double twice = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        auto const& a = corners[i];
        auto const& b = corners[(i + 1) % corners.size()];
        twice += a[0] * b[1] - b[0] * a[1];
    }
    return std::abs(twice) / 2;
}

bool is_area(json const& value) {
    auto const is_corner = [](json const& each) {
        return each.is_array() && each.size() == 2 && each[0].is_number() && each[1].is_number();
    };
    return value.is_array() && value.size() >= 3 && std::ranges::all_of(value, is_corner);
}

// Reads the section. Errors are reported by `bad(key, text)`, which does not return.
template <class Bad>
choosing::Settings read(json const& section, std::vector<remote::SubEngine> const& engines, Bad const& bad) {
    choosing::Settings settings;
    auto const must_be = [&](std::string const& key, std::string const& expected) {
        bad(key, key + " must be " + expected + ", not " + rois::quoted(section[key].dump(), 100));
    };
    for (auto const& [key, value] : section.items())
        if (key != "logical" && key != "sensing" && key != "engines" && key != "areas" && key != "low_battery")
            bad(key, rois::quoted(key) + " is not a key of \"choosing\": " + std::string{expected_key});
    if (!section.contains("engines") || (!section.contains("logical") && !section.contains("sensing")))
        bad("", "\"choosing\" is not complete: " + std::string{expected_key});
    std::set<std::string> taken;
    auto const names_of = [&](std::string const& key) {
        if (!is_list_of_names(section[key]))
            must_be(key, R"(a list of different names, none of them empty, such as ["robot1", "robot2"])");
        return section[key].template get<std::vector<std::string>>();
    };
    for (auto [key, names] : {std::pair{"logical", &settings.logical}, std::pair{"sensing", &settings.sensing}}) {
        if (!section.contains(key)) continue;
        *names = names_of(key);
        for (auto const& name : *names) {
            if (name.find('.') != name.npos)
                bad(key, rois::quoted(name) + " must be the name of a component without its engine, such as \"navigation\"");
            if (auto const why = why_not_in(key, name); !why.empty()) bad(key, rois::quoted(name) + " " + why);
            if (!taken.insert(name).second) bad(key, rois::quoted(name) + " is in \"logical\" already");
        }
    }
    settings.engines = names_of("engines");
    for (auto const& name : settings.engines)
        if (std::ranges::find(engines, name.substr(0, name.find('.')), &remote::SubEngine::name) == engines.end())
            bad("engines", rois::quoted(name) +
                               " is not known: it must be the name of a sub engine of this file, or of an engine of one, such as "
                               "\"hall.robot1\"");
    if (section.contains("low_battery")) {
        auto const& percent = section["low_battery"];
        if (!percent.is_number_integer() || percent < 0 || percent > 100) must_be("low_battery", "a number of percent, 0 to 100");
        settings.low_battery = percent.template get<int>();
    }
    if (!section.contains("areas")) return settings;
    if (!section["areas"].is_object()) must_be("areas", "an object with the name and the area of an engine");
    for (auto const& [name, corners] : section["areas"].items()) {
        if (std::ranges::find(settings.engines, name) == settings.engines.end())
            bad("areas", "areas: " + rois::quoted(name) + " is not in \"engines\"");
        if (!is_area(corners))
            bad("areas", "the area of " + rois::quoted(name) + " must have at least three corners, [x, y] in mm, not " +
                             rois::quoted(corners.dump(), 100));
        auto const& area = settings.areas[name] = corners.template get<choosing::Area>();
        if (!(surface(area) > 0))
            bad("areas", "the area of " + rois::quoted(name) +
                             " has no surface: its corners must not lie on one line, nor its sides cross, as " +
                             rois::quoted(corners.dump(), 100) + " do");
    }
    return settings;
}

}  // namespace

choosing::Settings read_choosing(std::string const& file, std::vector<remote::SubEngine> const& engines) {
    auto const text = text_of_file(file);
    auto const object = parse_json(file, text);
    if (!object.contains("choosing")) return {};
    auto const objects = objects_in(text);
    auto const& keys = objects.front().keys;
    auto const at = std::ranges::find(keys, "choosing", &ObjectInText::Key::name)->at;
    auto const in_text = std::ranges::find_if(objects, [&](auto const& each) { return each.begin > at; });
    auto const bad = [&](std::string const& key, std::string const& what) {
        throw BadSettings{file + ":" + place_of_key(text, *in_text, key) + ": " + what};
    };
    if (!object["choosing"].is_object())
        throw BadSettings{file + ":" + place_of_key(text, "choosing") + ": choosing must be an object, { ... }"};
    if (auto const* twice = in_text->repeated())
        throw BadSettings{file + ":" + place_of(text, twice->at) + ": " + rois::quoted(twice->name) +
                          " is given twice in \"choosing\""};
    if (auto const areas = std::ranges::find(in_text->keys, "areas", &ObjectInText::Key::name); areas != in_text->keys.end()) {
        auto const inner = std::ranges::find_if(objects, [&](auto const& each) { return each.begin > areas->at; });
        auto const* twice = object["choosing"]["areas"].is_object() && inner != objects.end() ? inner->repeated() : nullptr;
        if (twice != nullptr)
            throw BadSettings{file + ":" + place_of(text, twice->at) + ": " + rois::quoted(twice->name) +
                              " is given twice in \"areas\""};
    }
    return read(object["choosing"], engines, bad);
}

}  // namespace rois
