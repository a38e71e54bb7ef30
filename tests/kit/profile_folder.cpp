#include "kit/profile_folder.hpp"

#include <unistd.h>

#include <atomic>
#include <fstream>

namespace rois::kit {

ProfileFolder::ProfileFolder() {
    static std::atomic<int> made = 0;
    path_ = std::filesystem::temp_directory_path() / ("rois-profiles-" + std::to_string(getpid()) + "-" + std::to_string(++made));
    std::filesystem::create_directory(path_);
}

ProfileFolder::~ProfileFolder() { std::filesystem::remove_all(path_); }

void ProfileFolder::put(std::string const& file, std::string const& text) const { std::ofstream{path_ / file} << text; }

void ProfileFolder::remove(std::string const& file) const { std::filesystem::remove(path_ / file); }

std::string profile_document(std::string const& urn, std::string const& content, std::string const& object) {
    return "<rois:HRIComponentProfile xmlns:rois=\"http://www.omg.org/spec/RoIS/20240801\" "
           "xmlns:gml=\"http://www.opengis.net/gml/3.2\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
           "xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" gml:id=\"profile\">" +
           object + "\n<gml:identifier codeSpace=\"urn:ietf:rfc:2141\">" + urn + "</gml:identifier>\n" + content +
           "</rois:HRIComponentProfile>\n";
}

}  // namespace rois::kit
