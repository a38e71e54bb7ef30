#include "basic/components/reaction_types.hpp"

#include <algorithm>

#include "types/text/texts.hpp"

namespace rois::basic {

std::array<ReactionType, 50> const reaction_types{{{"nod the head", 1.2},
                                                   {"angle the head", 1.5},
                                                   {"shake the head", 1.6},
                                                   {"look right", 1.5},
                                                   {"look left", 1.5},
                                                   {"look up", 1.5},
                                                   {"look down", 1.5},
                                                   {"drop the head", 2.0},
                                                   {"bow the head", 2.4},
                                                   {"shake hands", 3.0},
                                                   {"spread hands slightly", 1.6},
                                                   {"raise hands and spread", 2.4},
                                                   {"spread hands", 2.0},
                                                   {"clap hands", 2.0},
                                                   {"clap hands rhythmically", 4.0},
                                                   {"point by the right hand", 2.2},
                                                   {"point by the left hand", 2.2},
                                                   {"indicate a monitor display", 2.5},
                                                   {"raise both hands", 2.0},
                                                   {"raise both hands from side", 2.4},
                                                   {"raise both hands at the shoulder height", 2.0},
                                                   {"raise a hand straight up (1, waving)", 2.8},
                                                   {"raise a hand straight up (2)", 2.0},
                                                   {"raise the right hand", 1.8},
                                                   {"raise the left hand", 1.8},
                                                   {"turn the right palm down", 1.5},
                                                   {"turn the left palm up", 1.5},
                                                   {"wave the hand", 2.4},
                                                   {"move the fingertip up", 1.5},
                                                   {"cross arms (an X)", 2.0},
                                                   {"make a circle with arms", 2.2},
                                                   {"put both hands on the head", 2.2},
                                                   {"put a hand on forehead", 2.0},
                                                   {"salute", 1.8},
                                                   {"put a hand to ear", 2.0},
                                                   {"put a hand to mouth", 2.0},
                                                   {"make a V sign", 1.8},
                                                   {"strike the chest lightly", 1.8},
                                                   {"rub the stomach", 2.6},
                                                   {"put a hand on the waist", 1.8},
                                                   {"put both hands on the waist (1)", 2.0},
                                                   {"put both hands on the waist (2, head up)", 2.2},
                                                   {"cross arms (in front of chest)", 2.0},
                                                   {"swing arms back and forth", 3.0},
                                                   {"knock", 1.5},
                                                   {"push by both hands", 1.8},
                                                   {"indicate a height by a hand", 2.0},
                                                   {"bend an arm", 1.8},
                                                   {"put an arm on a shoulder", 2.2},
                                                   {"glance at a wristwatch", 2.0}}};

namespace {

struct SeenAs {
    std::string_view code;
    std::string_view gesture;
};

constexpr std::array<SeenAs, 12> seen_as{{{"1", "nod"},
                                          {"3", "shake_head"},
                                          {"9", "bow"},
                                          {"14", "clap"},
                                          {"15", "clap"},
                                          {"16", "point"},
                                          {"17", "point"},
                                          {"22", "raise_hand"},
                                          {"23", "raise_hand"},
                                          {"24", "raise_hand"},
                                          {"25", "raise_hand"},
                                          {"28", "wave"}}};

}  // namespace

std::string reaction_code(std::string_view code_or_name) {
    auto const text = trimmed(code_or_name);
    auto const number = to_int(text);
    if (number && *number >= 1 && *number <= static_cast<int>(reaction_types.size())) return std::to_string(*number);
    auto const found =
        std::ranges::find_if(reaction_types, [&](ReactionType const& r) { return equal_ignoring_case(r.name, text); });
    if (found != reaction_types.end()) return std::to_string(found - reaction_types.begin() + 1);
    auto const gesture = std::ranges::find_if(seen_as, [&](SeenAs const& one) { return equal_ignoring_case(one.gesture, text); });
    return gesture == seen_as.end() ? "" : std::string{gesture->code};
}

std::span<std::string_view const> gestures() {
    static constexpr std::array<std::string_view, 8> all{"wave",  "nod",        "shake_head", "bow",
                                                         "point", "raise_hand", "clap",       "thumbs_up"};
    return all;
}

std::string_view gesture_of(std::string_view code) {
    auto const found = std::ranges::find(seen_as, code, &SeenAs::code);
    return found == seen_as.end() ? std::string_view{} : found->gesture;
}

ReactionType const& reaction_type(std::string_view code) {
    return reaction_types.at(static_cast<std::size_t>(*to_int(code)) - 1);
}

}  // namespace rois::basic
