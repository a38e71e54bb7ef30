// A folder of component profiles, there as long as the test.
#pragma once

#include <filesystem>
#include <string>

namespace rois::test {

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

// A component profile of this URN: `object` stands behind the identifier, `content` behind that. The head is line 1.
std::string profile_document(std::string const& urn, std::string const& content, std::string const& object = "");

}  // namespace rois::test
