// The rules of the house that a program can check. Each rule reads a tree of files and returns its complaints, one line each:
// "file:line: problem".
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace rois::house {

using Tree = std::map<std::string, std::string, std::less<>>;  // path from the project's root -> the file's text
using Complaints = std::vector<std::string>;

// Reads all files of the project, except hidden folders (but .ci), build folders and installed packages.
Tree read_tree(std::filesystem::path const& root);

// Every #include under server/, components/ and client-cpp/ follows the arrows of ARCHITECTURE.md. Only one layer may see a
// third-party library, also through the headers of other layers. No forward declaration names a class of an upper layer.
Complaints against_layers(Tree const&);

// The layers below the network layer do not read a clock, sleep or use random devices: time and chance are passed in.
Complaints against_passed_in_time(Tree const&);

// A statement with a co_await has no argument in braces: g++ 12 copies the bytes of such a structure and destroys both.
Complaints against_braces_in_awaits(Tree const&);

// Files of C++, TypeScript and Python are short.
Complaints against_short_files(Tree const&);

// Lines of TypeScript and style sheets in web/*/src/ are short. A line that consists of a regular expression may be longer.
Complaints against_long_lines(Tree const&);

// Relative links in README.md, ARCHITECTURE.md, CONTRIBUTING.md, SECURITY.md, docs/*.md, web/*/README.md and tests/**/README.md
// lead to a file or folder.
Complaints against_links(Tree const&);

// docs/dependencies.md names every package that CMake finds (except those that the project installs), that ./dev installs, and
// that a package.json needs. A package-lock.json names no host.
Complaints against_named_dependencies(Tree const&);

// .dockerignore lets through all files and folders that the CMakeLists.txt of the gateway and of `rois` name.
Complaints against_incomplete_image(Tree const&);

// In docs/conformance*.md, each row names existing tests and source files and has a valid state. Every table, figure, annex and
// decision has a row. Every decision with a row that is done has a test with its number. The totals are correct.
Complaints against_proof(Tree const&);

}  // namespace rois::house
