// What somebody writes who has installed the library: says which components of a type there are.
#include <iostream>
#include <rois/blocking.hpp>

int main() {
    rois::Blocking robot{rois::Settings{.url = rois::default_url()}};
    rois::Identifier const navigation{"navigation"};  // no warning for what is left out, nor above
    for (auto const& ref : robot.search(rois::conditions::type == "Navigation"))
        if (ref.code == navigation.code) std::cout << ref.code << '\n';
}
