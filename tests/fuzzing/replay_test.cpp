// The short run of the fuzzers: each target takes its corpus, and changes of it. ./dev fuzz searches for longer.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "fuzzing/targets.hpp"
#include "kit/cpu_time.hpp"

namespace rois::fuzzing {

namespace {

std::vector<std::string> corpus_of(std::string_view target) {
    std::vector<std::filesystem::path> files;
    for (auto const& entry :
         std::filesystem::directory_iterator{std::filesystem::path{ROIS_SOURCE_DIR "/tests/fuzzing/corpus"} / target})
        files.push_back(entry.path());
    std::ranges::sort(files);
    std::vector<std::string> inputs;
    for (auto const& file : files) {
        std::ostringstream text;
        text << std::ifstream{file, std::ios::binary}.rdbuf();
        inputs.push_back(text.str());
    }
    return inputs;
}

// Changes a few places: other bytes, missing or doubled pieces, and pieces of another input.
std::string changed(std::vector<std::string> const& inputs, std::mt19937& random) {
    auto const below = [&](std::size_t limit) { return std::uniform_int_distribution<std::size_t>{0, limit - 1}(random); };
    auto input = inputs[below(inputs.size())];
    for (auto changes = 1 + below(4); changes > 0 && !input.empty(); --changes) {
        auto const at = below(input.size());
        auto const size = std::min(input.size() - at, 1 + below(16));
        auto const& other = inputs[below(inputs.size())];
        switch (below(4)) {
            case 0:
                input[at] = static_cast<char>(below(256));
                break;
            case 1:
                input.erase(at, size);
                break;
            case 2:
                input.insert(at, input.substr(at, size));
                break;
            default:
                if (!other.empty()) input.replace(at, size, other.substr(below(other.size()), size));
        }
    }
    return input;
}

// An input that takes longer would be a way to keep the gateway busy.
constexpr std::chrono::milliseconds most_cpu_time{kit::has_sanitizer ? 2'000 : 200};

struct Fuzzing : testing::TestWithParam<Target> {
    static void run(std::string const& input) {
        std::chrono::nanoseconds took{};
        ASSERT_NO_THROW(took = kit::cpu_time_of([&] { GetParam().run(input); })) << testing::PrintToString(input);
        EXPECT_LE(took, most_cpu_time) << testing::PrintToString(input);
    }
};

}  // namespace

TEST_P(Fuzzing, FindsNoFaultInAShortRun) {
    auto const& target = GetParam();
    auto const inputs = corpus_of(target.name);
    ASSERT_FALSE(inputs.empty());
    target.run("");  // the first run makes what all runs share, such as the compiled schemas
    for (auto const& input : inputs) run(input);
    std::mt19937 random{1};
    constexpr int most = 500;
    for (int i = 0; i < most && !HasFatalFailure(); ++i) run(changed(inputs, random));
}

INSTANTIATE_TEST_SUITE_P(Each, Fuzzing, testing::ValuesIn(targets().begin(), targets().end()),
                         [](auto const& each) { return std::string{each.param.name}; });

}  // namespace rois::fuzzing
