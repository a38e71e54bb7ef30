#include "fuzz/samples.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace rois::fuzz {

std::vector<std::string> samples() {
    std::vector<std::filesystem::path> paths;
    for (auto const* folder : {"schemas/samples/valid", "schemas/samples/invalid", "schemas/profiles",
                               "components/simulation/profiles", "components/simulation/data", "tests/server/data"}) {
        for (auto const& entry : std::filesystem::directory_iterator{std::filesystem::path{ROIS_SOURCE_DIR} / folder}) {
            if (entry.path().extension() == ".xml") paths.push_back(entry.path());
        }
    }
    std::ranges::sort(paths);
    std::vector<std::string> texts;
    for (auto const& path : paths) {
        std::ifstream in{path, std::ios::binary};
        texts.emplace_back(std::istreambuf_iterator<char>{in}, std::istreambuf_iterator<char>{});
    }
    return texts;
}

}  // namespace rois::fuzz
