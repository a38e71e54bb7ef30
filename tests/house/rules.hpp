// The rules of the house that a machine can judge. Each rule reads a tree of files and answers with what breaks it:
// one line each, "file:line: what is wrong"; none when all is well.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace rois::house {

using Tree = std::map<std::string, std::string, std::less<>>;  // path from the project's root -> the file's text
using Complaints = std::vector<std::string>;

// Every file of the project; but no hidden folder (except .ci), nothing built, nothing that a package manager put there.
Tree read_tree(std::filesystem::path const& root);

// Every #include under server/, components/ and client-cpp/ points along the arrows of ARCHITECTURE.md, and a third-party
// library is seen by one layer only, also through the headers of others.
Complaints against_layers(Tree const&);

// Below the network layer nobody reads a clock, sleeps or throws dice: time and chance are passed in.
Complaints against_passed_in_time(Tree const&);

// No argument is made in braces in a statement with a co_await: g++ 12 copies the bytes of such a structure and destroys both.
Complaints against_braces_in_awaits(Tree const&);

// No file of C++, TypeScript or Python is too long to be read at one sitting.
Complaints against_short_files(Tree const&);

// A relative link in README.md, ARCHITECTURE.md, CONTRIBUTING.md, SECURITY.md, docs/*.md and web/*/README.md leads to a file or a
// folder.
Complaints against_links(Tree const&);

// docs/dependencies.md names every package that CMake looks for (but those that the project installs), every one that ./dev
// installs, and every one that a package.json wants; a package-lock.json names no host.
Complaints against_named_dependencies(Tree const&);

// In docs/conformance*.md each row names tests and source files that there are and has a state that there is; every table, figure
// and annex of the specification and every decision has a row; a decision of which something is done has a test that carries its
// number; the summary is true.
Complaints against_proof(Tree const&);

}  // namespace rois::house
