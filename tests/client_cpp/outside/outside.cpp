// A user's program with the installed library: prints the components of a type.
#include <iostream>
#include <rois/blocking.hpp>

int main() {
    rois::Blocking robot{rois::Settings{.url = rois::default_url()}};
    rois::Identifier const navigation{"navigation"};  // left-out members must cause no warning, here and above
    for (auto const& ref : robot.search(rois::conditions::type == "Navigation"))
        if (ref.code == navigation.code) std::cout << ref.code << '\n';
}
