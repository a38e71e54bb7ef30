// Profiles and their sub components.
#include "types/profiles.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

namespace rois {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

namespace {

struct Made {
    std::string urn;
    std::vector<std::string> parts = {};
    std::vector<std::string> commands = {};
    std::vector<std::string> parameters = {};
};

ComponentProfile profile(Made const& made) {
    ComponentProfile p;
    p.object.identifier = made.urn;
    p.sub_components = made.parts;
    for (auto const& name : made.commands)
        p.messages.push_back({.kind = MessageKind::command, .name = name, .results = {}, .arguments = {}, .timeout = {}});
    for (auto const& name : made.parameters)
        p.parameters.push_back({.name = name, .data_type_ref = {}, .default_value = {}, .description = made.urn});
    return p;
}

std::vector<std::string> names(auto const& list) {
    std::vector<std::string> all;
    for (auto const& each : list) all.push_back(each.name);
    return all;
}

}  // namespace

TEST(Flattened, HasTheMessagesOfSubComponentsAfterItsOwn) {
    std::vector const known{profile({"urn:base", {}, {"start", "stop"}, {"volume"}}),
                            profile({"urn:middle", {"urn:base"}, {"pause"}, {"language"}})};
    auto const whole = flattened(profile({"urn:top", {"URN:Middle "}, {"speak"}, {"text"}}), known);
    EXPECT_THAT(names(whole.messages), ElementsAre("speak", "pause", "start", "stop"));
    EXPECT_THAT(names(whole.parameters), ElementsAre("text", "language", "volume"));
    EXPECT_EQ(whole.object.identifier, "urn:top");
    EXPECT_THAT(whole.sub_components, ElementsAre("URN:Middle "));
}

TEST(Flattened, HasUniqueNamesAndItsOwnFirst) {
    std::vector const known{profile({"urn:base", {}, {"start"}, {"Volume", "pitch"}})};
    auto const whole = flattened(profile({"urn:top", {"urn:base"}, {"start"}, {"volume"}}), known);
    EXPECT_THAT(names(whole.messages), ElementsAre("start"));
    EXPECT_THAT(names(whole.parameters), ElementsAre("volume", "pitch"));
    EXPECT_EQ(whole.parameters.front().description, "urn:top");
}

TEST(Flattened, UsesTheFirstDefinitionOfAParameterInAllMessages) {
    auto const parameter = [](std::string name, std::string type, std::optional<std::string> value) {
        return ParameterProfile{.name = std::move(name),
                                .data_type_ref = {.code = std::move(type), .authority = {}, .codebook_ref = {}, .version = {}},
                                .default_value = std::move(value),
                                .description = {}};
    };
    auto base = profile({"urn:base"});
    base.messages = {{.kind = MessageKind::command,
                      .name = "set_parameter",
                      .results = {},
                      .arguments = {parameter("volume", "int", "50"), parameter("pitch", "int", "3")},
                      .timeout = {}},
                     {.kind = MessageKind::query,
                      .name = "get_parameter",
                      .results = {parameter("volume", "int", {})},
                      .arguments = {},
                      .timeout = {}}};
    base.parameters = {parameter("volume", "int", "50"), parameter("pitch", "int", "3")};
    auto top = profile({"urn:top", {"urn:base"}});
    top.parameters = {parameter("Volume", "string", "loud"), parameter("pitch", "int", "7")};
    auto const whole = flattened(top, {base});
    auto const said = [](std::vector<ParameterProfile> const& list) {
        std::vector<std::string> all;
        for (auto const& each : list) all.push_back(each.data_type_ref.code + " " + each.default_value.value_or("none"));
        return all;
    };
    EXPECT_THAT(said(whole.messages.at(0).arguments), ElementsAre("string loud", "int 7"));
    EXPECT_THAT(said(whole.messages.at(1).results), ElementsAre("string loud"));
    EXPECT_THAT(said(whole.parameters), ElementsAre("string loud", "int 7"));

    auto sets = profile({"urn:sets", {"urn:base"}});
    sets.messages = {{.kind = MessageKind::command,
                      .name = "set_parameter",
                      .results = {},
                      .arguments = {parameter("volume", "string", {})},
                      .timeout = {}}};
    EXPECT_THAT(said(flattened(sets, {base}).parameters), ElementsAre("string none", "int 3"));
}

TEST(Flattened, MayIncludeASubComponentTwice) {
    std::vector const known{profile({"urn:base", {}, {"start"}}), profile({"urn:left", {"urn:base"}, {"l"}}),
                            profile({"urn:right", {"urn:base"}, {"r"}})};
    EXPECT_THAT(names(flattened(profile({"urn:top", {"urn:left", "urn:right"}}), known).messages),
                ElementsAre("l", "start", "r"));
}

TEST(Flattened, ThrowsForAnUnknownSubComponent) {
    EXPECT_THAT(
        [] {
            flattened(profile({"urn:top", {"urn:gone"}}), {});
        },
        ThrowsMessage<std::runtime_error>("no component profile 'urn:gone' is known"));
}

TEST(Flattened, ThrowsForAProfileThatIncludesItself) {
    std::vector const known{profile({"urn:a", {"urn:b"}}), profile({"urn:b", {"urn:a"}}), profile({"urn:self", {"urn:self"}})};
    EXPECT_THAT([&] { flattened(known[0], known); }, ThrowsMessage<std::runtime_error>(HasSubstr("includes itself")));
    EXPECT_THAT(
        [&] {
            flattened(profile({"urn:self", {"urn:self"}}), known);
        },
        ThrowsMessage<std::runtime_error>("the component profile 'urn:self' includes itself"));
}

TEST(Profile, IsFoundByUrnOrName) {
    std::vector known{profile({"urn:x-rois:def:component:OMG::RoISCommon"}), profile({"urn:x-rois:def:component:ATR::Lamp"}),
                      profile({"urn:a"})};
    known[1].object.name = "desk_lamp";
    EXPECT_THAT(find_profiles(known, " URN:X-ROIS:DEF:Component:omg::roiscommon "), ElementsAre(&known[0]));
    for (auto const* name : {"RoISCommon", "RoIS_Common", "roiscommon"})
        EXPECT_THAT(find_profiles(known, name), ElementsAre(&known[0])) << name;
    for (auto const* name : {"Lamp", "DeskLamp", "desk_lamp"})
        EXPECT_THAT(find_profiles(known, name), ElementsAre(&known[1])) << name;
    EXPECT_THAT(find_profiles(known, "urn:x-rois:def:component:OMG::Lamp"), IsEmpty()) << "the authority differs";
    EXPECT_THAT(find_profiles(known, ""), IsEmpty());
    EXPECT_THAT(find_profiles(known, "a"), ElementsAre(&known[2]));
}

TEST(Messages, AreFoundByKindAndName) {
    auto const p = profile({"urn:top", {}, {"start", "stop"}});
    EXPECT_EQ(find_message(p, MessageKind::command, "stop"), &p.messages[1]);
    EXPECT_EQ(find_message(p, MessageKind::command, "Stop"), nullptr);
    EXPECT_EQ(find_message(p, MessageKind::query, "stop"), nullptr);
}

TEST(Parameters, AreFoundInAnyCase) {
    auto const p = profile({"urn:top", {}, {}, {"SSML_text"}});
    EXPECT_EQ(find_parameter(p.parameters, "ssml_TEXT"), &p.parameters[0]);
    EXPECT_EQ(find_parameter(p.parameters, "text"), nullptr);
}

}  // namespace rois
