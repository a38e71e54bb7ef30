// A user's program with the installed C++ PSM: both ways to include its headers work.
#include <RoIS_HRI.hpp>
#include <iostream>
#include <rois/psm/RoIS_Navigation.hpp>
#include <rois/psm/reason.hpp>

int main() {
    RoIS_HRI::SystemIF system;
    RoIS_HRI::CommandIF command;
    std::string ref;
    if (system.connect() != RoIS_HRI::OK || command.bind_any("", ref) != RoIS_HRI::OK) std::cerr << rois::psm::reason() << '\n';
    if (Navigation::Command{}.set_parameter({"desk"}, 0, "time") == RoIS_HRI::OK) std::cout << "navigation\n";
    system.disconnect();
}
