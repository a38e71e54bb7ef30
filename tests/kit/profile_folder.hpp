// A temporary folder of component profiles.
#pragma once

#include <filesystem>
#include <string>

namespace rois::kit {

// Exists as long as the object.
class ProfileFolder {
public:
    ProfileFolder();
    ~ProfileFolder();
    ProfileFolder(ProfileFolder const&) = delete;
    ProfileFolder& operator=(ProfileFolder const&) = delete;

    std::string name() const { return path_; }
    void put(std::string const& file, std::string const& text) const;
    void remove(std::string const& file) const;

private:
    std::filesystem::path path_;
};

// Returns a component profile with this URN. `object` is inserted before the identifier, `content` after it. The root's start tag
// is line 1.
std::string profile_document(std::string const& urn, std::string const& content, std::string const& object = "");

}  // namespace rois::kit
