// The fixture of most tests of the `rois` program.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command/rois_process.hpp"

namespace rois::test {

using nlohmann::json;

// Runs `rois` against the gateway that all tests share.
struct Rois : testing::Test {
    Ended run(std::vector<std::string> const& arguments, std::string const& input = {}) {
        return run_rois(arguments, input, at());
    }
    Variables at() const { return {{"ROIS_URL", shared_gateway().url()}}; }

    // Returns the JSON objects that the command prints.
    std::vector<json> objects(std::vector<std::string> arguments) {
        arguments.push_back("--json");
        auto const ended = run(arguments);
        EXPECT_EQ(ended.exit_code, 0) << ended.error;
        std::vector<json> all;
        for (auto const& line : lines_of(ended.out)) all.push_back(json::parse(line));
        return all;
    }

    void expect(int code, std::string const& says, std::vector<std::string> const& arguments) {
        auto const ended = run(arguments);
        EXPECT_EQ(ended.exit_code, code) << ended.out << ended.error;
        EXPECT_THAT(ended.error, testing::HasSubstr(says));
    }
};

constexpr auto messages = "xmlns='urn:x-rois:psm:xml:message:1' xmlns:rois='http://www.omg.org/spec/RoIS/20240801'";

}  // namespace rois::test
