#include <fstream>
#include <iterator>

#include "house/rules.hpp"

namespace rois::house {

namespace fs = std::filesystem;

namespace {

bool is_foreign(fs::path const& folder) {
    auto const name = folder.filename().string();
    return (name.starts_with('.') && name != ".ci") || name == "build" || name == "dist" || name == "node_modules";
}

std::string read(fs::path const& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

Tree read_tree(fs::path const& root) {
    Tree tree;
    for (fs::recursive_directory_iterator at(root), end; at != end; ++at) {
        if (at->is_directory()) {
            if (is_foreign(at->path())) at.disable_recursion_pending();
        } else if (at->is_regular_file()) {
            tree[at->path().lexically_relative(root).generic_string()] = read(at->path());
        }
    }
    return tree;
}

}  // namespace rois::house
