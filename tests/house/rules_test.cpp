// Breaks each rule, and checks the complaint and its place.
#include <gmock/gmock.h>

#include "house/rules.hpp"
#include "house/text.hpp"

namespace rois::house {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

TEST(Layers, PointDown) {
    Tree const tree{
        {"server/types/ids.hpp", "#include <string>\n"},
        {"server/xml/codec/codec.hpp", "#include \"types/ids.hpp\"\n"},
        {"server/xml/codec.cpp", "#include \"xml/codec/codec.hpp\"\n#include <pugixml.hpp>\n#include <xercesc/sax2/X.hpp>\n"},
        {"server/net/web.cpp", "#include \"xml/codec/codec.hpp\"\n#include <boost/asio.hpp>\n#include <sys/socket.h>\n"},
        {"components/simulation/world/hall.cpp", "#include <Eigen/Core>\n#include \"types/ids.hpp\"\n"}};
    EXPECT_THAT(against_layers(tree), IsEmpty());
}

TEST(Layers, AnArrowThatPointsUpIsFound) {
    Tree const tree{{"server/types/ids.hpp", "// ids\n#include \"xml/codec/codec.hpp\"\n"},
                    {"server/engine/engine.cpp", "#  include \"net/web.hpp\"\n"},
                    {"server/net/web.hpp", ""},
                    {"server/xml/codec/codec.hpp", ""}};
    EXPECT_THAT(against_layers(tree), ElementsAre("server/engine/engine.cpp:1: server/engine/ may not use \"net/web.hpp\"",
                                                  "server/types/ids.hpp:2: server/types/ may not use \"xml/codec/codec.hpp\""));
}

TEST(Layers, SiblingsDoNotKnowEachOther) {
    Tree const tree{
        {"server/engine/engine.cpp", "#include \"xml/codec/codec.hpp\"\n"},
        {"server/xml/codec/codec.hpp", "#include \"engine/engine.hpp\"\n"},
        {"server/engine/engine.hpp", ""},
        {"components/simulation/world/hall.cpp", "#include \"xml/codec/codec.hpp\"\n#include \"xml/profiles/document.hpp\"\n"},
        {"server/xml/profiles/document.hpp", ""}};
    EXPECT_THAT(against_layers(tree),
                ElementsAre("components/simulation/world/hall.cpp:1: components/simulation/ may not use \"xml/codec/codec.hpp\"",
                            "server/engine/engine.cpp:1: server/engine/ may not use \"xml/codec/codec.hpp\"",
                            "server/xml/codec/codec.hpp:1: server/xml/ may not use \"engine/engine.hpp\""));
}

TEST(Layers, TheGatewayKnowsNoSockets) {
    Tree const tree{
        {"server/gateway/gateway.cpp", "#include \"engine/engine.hpp\"\n#include \"net/web.hpp\"\n#include <boost/asio.hpp>\n"},
        {"server/engine/engine.hpp", "#include \"gateway/gateway.hpp\"\n"},
        {"server/gateway/gateway.hpp", ""},
        {"server/net/web.cpp", "#include \"gateway/gateway.hpp\"\n"},
        {"server/net/web.hpp", ""}};
    EXPECT_THAT(against_layers(tree),
                ElementsAre("server/engine/engine.hpp:1: server/engine/ may not use \"gateway/gateway.hpp\"",
                            "server/gateway/gateway.cpp:2: server/gateway/ may not use \"net/web.hpp\"",
                            "server/gateway/gateway.cpp:3: server/gateway/ may not see <boost/asio.hpp>"));
}

TEST(Layers, ALibraryBelongsToOneLayer) {
    Tree const tree{{"server/engine/engine.cpp", "#include <vector>\n#include <boost/asio.hpp>\n"},
                    {"server/files/ids.hpp", "#include <unistd.h>\n"},
                    {"server/main/main.cpp", "#include <CLI/CLI.hpp>\n#include <Eigen/Core>\n"}};
    EXPECT_THAT(against_layers(tree), ElementsAre("server/engine/engine.cpp:2: server/engine/ may not see <boost/asio.hpp>",
                                                  "server/files/ids.hpp:1: server/files/ may not see <unistd.h>",
                                                  "server/main/main.cpp:2: server/main/ may not see <Eigen/Core>"));
}

TEST(Layers, ALibraryIsNotVisibleThroughAHeader) {
    Tree const tree{{"server/main/main.cpp", "#include \"net/web.hpp\"\n"},
                    {"server/net/web.hpp", "#include \"net/socket.hpp\"\n"},
                    {"server/net/web.cpp", "#include \"net/web.hpp\"\n"},
                    {"server/net/socket.hpp", "#include <boost/asio.hpp>\n"}};
    EXPECT_THAT(against_layers(tree),
                ElementsAre("server/main/main.cpp:1: server/main/ may not see <boost/asio.hpp> through server/net/socket.hpp"));
}

TEST(Layers, PosesMayBeVisibleThroughAHeader) {
    Tree const tree{{"server/main/main.cpp", "#include \"simulation/world/pose.hpp\"\n"},
                    {"components/simulation/world/pose.hpp", "#include <Eigen/Geometry>\n"}};
    EXPECT_THAT(against_layers(tree), IsEmpty());
}

TEST(Layers, ADeclarationOfAClassThatAnUpperLayerDefinesIsFound) {
    Tree const tree{
        {"server/engine/queue.hpp", "#include <memory>\n// struct Reader;\nstruct Audience;\nclass Queue;\nclass Unknown;\n"},
        {"server/engine/queue.cpp", "class Queue {};\n"},
        {"server/gateway/readers.cpp", "struct rois::Audience {\n};\nclass Reader final : public Base {\n};\n"},
        {"server/gateway/gateway.hpp", "class Queue;\nclass Reader;\n"},
        {"server/net/web.hpp", "class Reader;\n"}};
    EXPECT_THAT(against_layers(tree), ElementsAre("server/engine/queue.hpp:3: server/engine/ may not declare Audience, which "
                                                  "server/gateway/ defines"));
}

TEST(Layers, ADeclarationMayNameAClassOfItsOwnLayerThatAnotherLayerHasToo) {
    Tree const tree{{"server/engine/queue.hpp", "class Place;\n"},
                    {"server/engine/queue.cpp", "class Place {};\n"},
                    {"server/net/admission.hpp", "class Place {};\n"}};
    EXPECT_THAT(against_layers(tree), IsEmpty());
}

TEST(Layers, EveryFolderIsInOne) {
    Tree const tree{{"server/gossip/rumour.cpp", ""}, {"client-cpp/client.hpp", ""}, {"tests/engine/engine_test.cpp", ""}};
    EXPECT_THAT(against_layers(tree),
                ElementsAre("client-cpp/client.hpp:1: this folder is in no layer: tests/house/layers.cpp lists them",
                            "server/gossip/rumour.cpp:1: this folder is in no layer: tests/house/layers.cpp lists them"));
}

TEST(Layers, AnIncludeOfAMissingFileIsFound) {
    Tree const tree{{"server/types/ids.cpp", "#include \"ids.hpp\"\n"}, {"server/types/ids.hpp", ""}};
    EXPECT_THAT(against_layers(tree),
                ElementsAre("server/types/ids.cpp:1: \"ids.hpp\" is not a file under server/, components/ or client-cpp/"));
}

TEST(PassedInTime, IsReadByTheNetworkAndMainAlone) {
    auto const reading = "auto t = std::chrono::steady_clock::now();\n";
    Tree const tree{{"server/engine/engine.cpp", reading}, {"server/net/web.cpp", reading}, {"server/main/main.cpp", reading}};
    EXPECT_THAT(against_passed_in_time(tree),
                ElementsAre("server/engine/engine.cpp:1: time and chance are passed to server/engine/, not read: ::now"));
}

TEST(PassedInTime, IsReadByManyFunctions) {
    Tree const tree{{"components/simulation/world/hall.cpp",
                     "std::time(nullptr);\n"
                     "Steady::clock :: now();\n"
                     "std::this_thread::sleep_for(1s);\n"
                     "std::random_device chance;\n"
                     "clock_gettime(CLOCK_MONOTONIC, &t);\n"
                     "auto const read = &std::chrono::steady_clock::now;\n"
                     "WorldTime Hall::now() const { return now >= time(leg) ? now : runtime(0); }\n"}};
    EXPECT_EQ(against_passed_in_time(tree).size(), 6U);
}

TEST(PassedInTime, MayBeNamedInCommentsAndTexts) {
    Tree const tree{{"server/types/instant.hpp",
                     "// nobody calls steady_clock::now() here\n"
                     "/* nor\n system_clock::now() */ auto text = \"::now\" R\"x(::now\n\")x\";\n"
                     "auto million = 1'000'000; auto quote = '\"'; auto tick = '\\'';\n"}};
    EXPECT_THAT(against_passed_in_time(tree), IsEmpty());
}

TEST(CodeAlone, KeepsItsLinesAndItsCode) {
    EXPECT_EQ(code_alone("a // b\nc \"d\\\"e\" f\n/* g\nh */ i"), "a     \nc        f\n    \n     i");
    EXPECT_EQ(code_alone("1'000 R\"(x\ny)\" z"), "1'000     \n    z");
}

TEST(BracesInAwaits, AreFound) {
    Tree const tree{{"client-cpp/command/recording/front.cpp",
                     "co_await write(message,\n    {FaultCode::not_found, \"no; not here\", {}, {}});\n"
                     "auto const all = co_await client.call(Search{});\n"
                     "co_return co_await follow.follow(rois::FollowParameters{.distance = 1_m});\n"}};
    EXPECT_THAT(against_braces_in_awaits(tree), ElementsAre(StartsWith("client-cpp/command/recording/front.cpp:1: "),
                                                            StartsWith("client-cpp/command/recording/front.cpp:3: "),
                                                            StartsWith("client-cpp/command/recording/front.cpp:4: ")));
}

TEST(BracesInAwaits, AreAllowedElsewhere) {
    Tree const tree{{"a.cpp",
                     "Search const all{};\nco_await client.call(all);\nother(Search{});\n"
                     "co_await socket.async_close(websocket::close_reason{code, \"why\"}, [] { return 1; });\n"
                     "co_await Facade{robot.component(name)}.position();  // not f({})\n"}};
    EXPECT_THAT(against_braces_in_awaits(tree), IsEmpty());
}

TEST(ShortFiles, EndAtFiveHundredLines) {
    auto const lines = [](std::size_t number) {
        std::string text;
        while (number-- > 0) text += "\n";
        return text;
    };
    Tree const tree{{"server/a.cpp", lines(501)},
                    {"tests/b.hpp", lines(500)},
                    {"docs/c.md", lines(900)},
                    {"web/client/src/d.ts", lines(502)},
                    {"web/client/src/e.ts", lines(500)}};
    EXPECT_THAT(against_short_files(tree), ElementsAre("server/a.cpp:501: has 501 lines, more than 500",
                                                       "web/client/src/d.ts:501: has 502 lines, more than 500"));
}

TEST(LongLines, AreReportedInTypeScriptAndStyleSheetsOfTheWeb) {
    auto const line = [](std::size_t length) { return std::string(length, 'a') + "\n"; };
    Tree const tree{{"server/a.cpp", line(141)},
                    {"web/client/src/b.ts", "\n" + line(141)},
                    {"web/client/tests/c.ts", line(141)},
                    {"web/console/src/d.tsx", line(140)},
                    {"web/console/src/e/f.css", line(150)}};
    EXPECT_THAT(against_long_lines(tree), ElementsAre("web/client/src/b.ts:2: has 141 characters, more than 140",
                                                      "web/console/src/e/f.css:1: has 150 characters, more than 140"));
}

TEST(LongLines, AreCountedInCharactersNotInBytes) {
    std::string text;
    for (int i = 0; i < 140; ++i) text += "\u72b6";
    EXPECT_THAT(against_long_lines({{"web/console/src/a.ts", text}}), IsEmpty());
    EXPECT_THAT(against_long_lines({{"web/console/src/a.ts", text + "a"}}), SizeIs(1));
}

TEST(LongLines, MayBeRegularExpressionsButNotComments) {
    auto const rest = std::string(140, 'a');
    EXPECT_THAT(against_long_lines({{"web/client/src/a.ts", "  /" + rest + "/y;\n"}}), IsEmpty());
    EXPECT_THAT(against_long_lines({{"web/client/src/a.ts", "  // " + rest + ";\n"}}), SizeIs(1));
    EXPECT_THAT(against_long_lines({{"web/client/src/a.ts", "  /* " + rest + ";\n"}}), SizeIs(1));
}

TEST(TheImage, HasAllThatCMakeNames) {
    Tree const tree{{".dockerignore", "*\n!cmake\n!docker/a.json\n"},
                    {"server/CMakeLists.txt",
                     "x(${PROJECT_SOURCE_DIR}/cmake/b.cmake ${PROJECT_SOURCE_DIR}/docker/a.json)\n"
                     "file(READ ${PROJECT_SOURCE_DIR}/docker/c.json text)\n"},
                    {"tests/CMakeLists.txt", "x(${PROJECT_SOURCE_DIR}/docs)\n"}};
    EXPECT_THAT(against_incomplete_image(tree),
                ElementsAre("server/CMakeLists.txt:2: docker/c.json is not in the image: add it to .dockerignore"));
}

TEST(Links, LeadToFilesAndFolders) {
    Tree const tree{
        {"README.md", "[a](docs/a.md#part) [b](docs/) ![c](./docs/a.md \"c\") [d](#here) [e](https://rois.example/x)\n"},
        {"docs/a.md", "[up](../README.md)\n`[no](link)`\n```\n[no](link)\n```\n"},
        {"server/notes.md", "[not](judged)\n"}};
    EXPECT_THAT(against_links(tree), IsEmpty());
}

TEST(Links, ThatLeadNowhereAreFound) {
    Tree const tree{{"ARCHITECTURE.md", "text\n[a](docs/a.md), [b](docs/b.md)\n"},
                    {"CONTRIBUTING.md", "[c]: docs/c.md\n"},
                    {"docs/a.md", "```\n[no](link)\n```\n[d](docs/a.md)\n"},
                    {"web/client/README.md", "[e](../server)\n"}};
    EXPECT_THAT(against_links(tree),
                ElementsAre("ARCHITECTURE.md:2: docs/b.md leads nowhere", "CONTRIBUTING.md:1: docs/c.md leads nowhere",
                            "docs/a.md:4: docs/a.md leads nowhere", "web/client/README.md:1: ../server leads nowhere"));
}

TEST(Dependencies, AreNamedByTheDocument) {
    Tree const tree{{"CMakeLists.txt", "find_package(Boost 1.81 REQUIRED)\nfind_package(Magic)\n"},
                    {"server/CMakeLists.txt", "    find_package(spdlog REQUIRED)\n"},
                    {"dev", "packages='\nbuild  g++       compiles\ntest   libmagic-dev  conjures\nbench  wizard  races\n'\n"},
                    {"docs/dependencies.md", "| `Boost` | `spdlog` | `g++` |\n"}};
    EXPECT_THAT(against_named_dependencies(tree), ElementsAre("CMakeLists.txt:2: docs/dependencies.md does not name `Magic`",
                                                              "dev:3: docs/dependencies.md does not name `libmagic-dev`",
                                                              "dev:4: docs/dependencies.md does not name `wizard`"));
}

TEST(Dependencies, AreNotWhatTheProjectInstalls) {
    Tree const tree{{"client/cmake/OursConfig.cmake.in", ""},
                    {"tests/outside/CMakeLists.txt", "find_package(Ours REQUIRED)\nfind_package(Theirs)\n"},
                    {"docs/dependencies.md", ""}};
    EXPECT_THAT(against_named_dependencies(tree),
                ElementsAre("tests/outside/CMakeLists.txt:2: docs/dependencies.md does not name `Theirs`"));
}

TEST(Dependencies, OfJavaScriptAreNamedToo) {
    Tree const tree{{"web/package.json",
                     "{\n  \"name\": \"x\",\n  \"devDependencies\": {\n    \"known\": \"1\",\n    \"magic\": \"2\"\n  },\n  "
                     "\"y\": \"z\"\n}\n"},
                    {"web/client/package.json", "{\n  \"dependencies\": {\n    \"wand\": \"1\"\n  }\n}\n"},
                    {"docs/dependencies.md", "| `known` |\n"}};
    EXPECT_THAT(against_named_dependencies(tree),
                ElementsAre("web/client/package.json:3: docs/dependencies.md does not name `wand`",
                            "web/package.json:5: docs/dependencies.md does not name `magic`"));
}

TEST(Dependencies, AreLockedWithoutAHost) {
    Tree const tree{{"web/package-lock.json", "\"resolved\": \"client\",\n\"resolved\": \"https://registry.example/a.tgz\",\n"}};
    EXPECT_THAT(against_named_dependencies(tree), ElementsAre("web/package-lock.json:2: a lock file must not name a host"));
}

TEST(Dependencies, NeedTheDocument) {
    EXPECT_THAT(against_named_dependencies({{"CMakeLists.txt", "find_package(Boost)\n"}}),
                ElementsAre("CMakeLists.txt:1: docs/dependencies.md does not name `Boost`"));
}

}  // namespace rois::house
