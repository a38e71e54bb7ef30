#include <algorithm>
#include <filesystem>
#include <optional>
#include <regex>

#include "house/rules.hpp"
#include "house/text.hpp"

namespace rois::house {

namespace {

constexpr std::ptrdiff_t longest_file = 500;                          // lines
constexpr auto one_file = "components/sdk/python/rois_component.py";  // may be longer: a program needs nothing else
constexpr std::ptrdiff_t longest_line = 140;                          // characters

constexpr auto dependencies = "docs/dependencies.md";

bool is_document(std::string_view file) {
    if (file == "ARCHITECTURE.md" || file == "CONTRIBUTING.md" || file == "SECURITY.md") return true;
    if (file == "README.md" || file.ends_with("/README.md")) return true;
    return file.starts_with("docs/") && file.ends_with(".md") && file.find('/', 5) == file.npos;
}

bool is_source(std::string_view file) {
    return is_cpp(file) || file.ends_with(".ts") || file.ends_with(".tsx") || file.ends_with(".py");
}

bool is_web_source(std::string_view file) {
    auto const is_in_source = file.starts_with("web/console/src/") || file.starts_with("web/client/src/");
    return is_in_source && (file.ends_with(".ts") || file.ends_with(".tsx") || file.ends_with(".css"));
}

// The number of characters of a text in UTF-8.
std::ptrdiff_t characters(std::string_view text) {
    return std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
}

// Whether a line of TypeScript consists of a regular expression, which cannot be broken.
bool is_expression(std::string_view line) {
    auto const begin = line.find_first_not_of(' ');
    if (begin == line.npos || line.substr(begin, 2) == "//" || line.substr(begin, 2) == "/*") return false;
    return line[begin] == '/' && (line.ends_with(';') || line.ends_with(','));
}

bool exists(Tree const& tree, std::string path) {
    while (path.ends_with('/')) path.pop_back();
    if (path.empty() || path == "." || tree.contains(path)) return true;
    auto const inside = tree.lower_bound(path + "/");
    return inside != tree.end() && inside->first.starts_with(path + "/");
}

// The file that a link in `document` leads to; nullopt if it leaves the project or stays on the page.
std::optional<std::string> target(std::string const& document, std::string link) {
    link = link.substr(0, link.find('#'));
    if (link.empty() || link.find("://") != link.npos || link.starts_with("mailto:")) return {};
    return (std::filesystem::path(document).parent_path() / link).lexically_normal().generic_string();
}

// The targets of `[text](target "title")` and `[label]: target` in a line, outside of code.
std::vector<std::string> links(std::string const& line) {
    static std::regex const code("`[^`]*`");
    static std::regex const link(R"re(\]\(\s*<?([^)\s>]+)[^)]*\)|^\s*\[[^\]]+\]:\s*<?([^\s>]+))re");
    auto const prose = std::regex_replace(line, code, "");
    std::vector<std::string> found;
    for (std::sregex_iterator at(prose.begin(), prose.end(), link), end; at != end; ++at)
        found.push_back((*at)[1].matched ? (*at)[1] : (*at)[2]);
    return found;
}

void judge_name(Tree const& tree, std::string const& where, std::string const& name, Complaints& complaints) {
    auto const document = tree.find(dependencies);
    if (document == tree.end() || document->second.find("`" + name + "`") == std::string::npos)
        complaints.push_back(where + dependencies + " does not name `" + name + "`");
}

// Checks the packages of a package.json's devDependencies and dependencies.
void judge_manifest(Tree const& tree, std::string const& file, std::string const& text, Complaints& complaints) {
    static std::regex const list(R"re(^\s*"(dev|peer|optional)?[dD]ependencies"\s*:.*)re");
    static std::regex const entry(R"re(^\s*"([^"]+)"\s*:\s*"[^"]*",?\s*)re");
    bool inside = false;
    for_each_line(text, [&](std::string const& line, std::size_t number) {
        std::smatch match;
        if (inside && std::regex_match(line, match, entry)) judge_name(tree, at(file, number), match[1], complaints);
        inside = std::regex_match(line, list) || (inside && line.find('}') == line.npos);
    });
}

// A lock file must not name the host of its packages: that is npm's default, or a setting of the installation.
void judge_lock(std::string const& file, std::string const& text, Complaints& complaints) {
    for_each_line(text, [&](std::string const& line, std::size_t number) {
        if (line.find(R"("resolved": "http)") != line.npos)
            complaints.push_back(at(file, number) + "a lock file must not name a host");
    });
}

}  // namespace

Complaints against_short_files(Tree const& tree) {
    Complaints complaints;
    for (auto const& [file, text] : tree) {
        auto const lines = std::ranges::count(text, '\n');
        if (is_source(file) && file != one_file && lines > longest_file)
            complaints.push_back(at(file, longest_file + 1) + "has " + std::to_string(lines) + " lines, more than " +
                                 std::to_string(longest_file));
    }
    return complaints;
}

Complaints against_long_lines(Tree const& tree) {
    Complaints complaints;
    for (auto const& [file, text] : tree) {
        if (!is_web_source(file)) continue;
        for_each_line(text, [&](std::string const& line, std::size_t number) {
            auto const length = characters(line);
            if (length > longest_line && !is_expression(line))
                complaints.push_back(at(file, number) + "has " + std::to_string(length) + " characters, more than " +
                                     std::to_string(longest_line));
        });
    }
    return complaints;
}

Complaints against_incomplete_image(Tree const& tree) {
    std::vector<std::string> let_through;
    if (auto const list = tree.find(".dockerignore"); list != tree.end())
        for_each_line(list->second, [&](std::string const& line, std::size_t) {
            if (line.starts_with('!')) let_through.push_back(line.substr(1));
        });
    auto const is_in_image = [&](std::string const& path) {
        return std::ranges::any_of(let_through, [&](auto const& one) { return path == one || path.starts_with(one + "/"); });
    };
    static std::regex const named{R"(\$\{PROJECT_SOURCE_DIR\}/([A-Za-z0-9_][A-Za-z0-9_./-]*))"};
    Complaints complaints;
    for (auto const& [file, text] : tree) {
        if (!file.ends_with("CMakeLists.txt") || file.starts_with("tests/") || file.starts_with("bench/")) continue;
        for_each_line(text, [&](std::string const& line, std::size_t number) {
            for (std::sregex_iterator each{line.begin(), line.end(), named}, end; each != end; ++each)
                if (auto const path = (*each)[1].str(); !is_in_image(path))
                    complaints.push_back(at(file, number) + path + " is not in the image: add it to .dockerignore");
        });
    }
    return complaints;
}

Complaints against_links(Tree const& tree) {
    Complaints complaints;
    for (auto const& [file, text] : tree) {
        if (!is_document(file)) continue;
        bool example = false;
        for_each_line(text, [&](std::string const& line, std::size_t number) {
            if (line.find("```") != line.npos) example = !example;
            if (example) return;
            for (auto const& link : links(line))
                if (auto const path = target(file, link); path && !exists(tree, *path))
                    complaints.push_back(at(file, number) + link + " leads nowhere");
        });
    }
    return complaints;
}

namespace {

// Packages that the project itself installs, for tests that use them.
bool is_our_package(Tree const& tree, std::string const& name) {
    return std::ranges::any_of(tree, [&](auto const& file) { return file.first.ends_with("/" + name + "Config.cmake.in"); });
}

}  // namespace

Complaints against_named_dependencies(Tree const& tree) {
    static std::regex const found_by_cmake(R"re(^\s*find_package\(\s*([^\s)]+).*)re");
    static std::regex const installed_by_dev(R"re(^(?:build|test|check|bench)\s+([a-z0-9][a-z0-9.+-]+)\s+\S.*)re");
    Complaints complaints;
    for (auto const& [file, text] : tree) {
        if (file.ends_with("/package.json")) judge_manifest(tree, file, text, complaints);
        if (file.ends_with("/package-lock.json")) judge_lock(file, text, complaints);
        bool const by_cmake = file == "CMakeLists.txt" || file.ends_with("/CMakeLists.txt") || file.ends_with(".cmake");
        if (!by_cmake && file != "dev") continue;
        for_each_line(text, [&](std::string const& line, std::size_t number) {
            std::smatch match;
            if (!std::regex_match(line, match, by_cmake ? found_by_cmake : installed_by_dev)) return;
            if (!by_cmake || !is_our_package(tree, match[1])) judge_name(tree, at(file, number), match[1], complaints);
        });
    }
    return complaints;
}

}  // namespace rois::house
