#include "fuzz/samples.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace rois::fuzz {

namespace {

// A grammar of annex C, of which there is no file.
constexpr auto grammar = R"(<?xml version="1.0"?>
<grammar xmlns="http://www.w3.org/2001/06/grammar" version="1.0" mode="voice" root="order" xml:lang="en" tag-format="semantics/1.0">
  <meta name="author" content="somebody"/>
  <tag>var x</tag>
  <rule id="order" scope="public">
    <example>bring me the map please</example>
    bring <item repeat="0-1" repeat-prob="0.5">me</item>
    <one-of><item weight="2.5">the <token xml:lang="en">map</token></item><item><ruleref uri="#thing"/></item></one-of>
    <ruleref special="GARBAGE"/>
  </rule>
  <rule id="thing">a newspaper</rule>
</grammar>
)";

}  // namespace

std::vector<std::string> samples() {
    std::vector<std::filesystem::path> paths;
    for (auto const* folder : {"schemas/samples/valid", "schemas/samples/invalid", "schemas/profiles",
                               "components/simulation/profiles", "components/simulation/data", "tests/server/data"}) {
        for (auto const& entry : std::filesystem::directory_iterator{std::filesystem::path{ROIS_SOURCE_DIR} / folder}) {
            if (entry.path().extension() == ".xml") paths.push_back(entry.path());
        }
    }
    std::ranges::sort(paths);
    std::vector<std::string> texts{grammar};
    for (auto const& path : paths) {
        std::ifstream in{path, std::ios::binary};
        texts.emplace_back(std::istreambuf_iterator<char>{in}, std::istreambuf_iterator<char>{});
    }
    return texts;
}

}  // namespace rois::fuzz
