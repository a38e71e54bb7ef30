#include <gmock/gmock.h>

#include "media/jpeg.hpp"
#include "media/stage.hpp"

namespace rois::media {
namespace {

using testing::Each;
using testing::HasSubstr;
using testing::StartsWith;

TEST(Jpeg, CanBeDecoded) {
    auto picture = plain(255, 0, 0);
    for (std::size_t i = 0; i < picture.rgb.size() / 2; i += 3) picture.rgb[i] = 0, picture.rgb[i + 2] = 255;  // the upper half
    auto const bitmap = decoded_jpeg(jpeg_of(picture));
    ASSERT_EQ(bitmap.width, 32u);
    ASSERT_EQ(bitmap.height, 16u);
    EXPECT_GT(bitmap.at(4, 2)[2], 200);
    EXPECT_GT(bitmap.at(4, 13)[0], 200);
}

TEST(Jpeg, RefusesAnIncompletePicture) {
    auto picture = plain(1, 2, 3);
    picture.rgb.pop_back();
    EXPECT_THROW(jpeg_of(picture), std::invalid_argument);
    EXPECT_THROW(jpeg_of({}), std::invalid_argument);
}

TEST(HttpFilm, IsOnePictureAfterAnother) {
    Stage stage;
    Screen screen;
    auto const outlet = stage.server.serve(screen.film(Film::Form::motion_jpeg), Flow::on);
    MediaReceiver receiving{outlet->address()};
    EXPECT_THAT(receiving.head(), HasSubstr("\r\nContent-Type: multipart/x-mixed-replace;boundary=picture\r\n"));
    EXPECT_EQ(colour_of(receiving.next_picture()), 'r');
    screen.colour = 'b';
    while (colour_of(receiving.next_picture()) == 'r') {
    }
    EXPECT_EQ(colour_of(receiving.next_picture()), 'b');
}

TEST(HttpFilm, BeginsWithTheFirstPicture) {
    Stage stage;
    Screen screen;
    screen.colour = '-';
    auto const outlet = stage.server.serve(screen.film(Film::Form::motion_jpeg), Flow::on);
    MediaReceiver receiving{outlet->address()};
    screen.colour = 'g';
    EXPECT_EQ(colour_of(receiving.next_picture()), 'g');
}

TEST(HttpFilm, SendsNothingWhileHeld) {
    Stage stage;
    Screen screen, other;
    auto const held = stage.server.serve(screen.film(Film::Form::motion_jpeg), Flow::on);
    auto const going_on = stage.server.serve(other.film(Film::Form::motion_jpeg), Flow::on);
    MediaReceiver receiving{held->address()}, witness{going_on->address()};
    receiving.next_picture();
    held->hold();
    for (int i = 0; i < 2; ++i) witness.next_picture();
    screen.colour = 'b';
    for (int i = 0; i < 5; ++i) witness.next_picture();
    screen.colour = 'g';
    held->go_on();
    char shown = 'r';
    while (shown == 'r') shown = colour_of(receiving.next_picture());
    EXPECT_EQ(shown, 'g');
}

TEST(HttpFilm, MayBeFetchedPictureByPicture) {
    Stage stage;
    Screen screen;
    auto const outlet = stage.server.serve(screen.film(Film::Form::jpeg), Flow::on);
    MediaReceiver first{outlet->address()};
    EXPECT_THAT(first.head(), StartsWith("HTTP/1.1 200 OK\r\nContent-Type: image/jpeg\r\n"));
    EXPECT_EQ(colour_of(first.line().rest()), 'r');
    outlet->hold();
    MediaReceiver held{outlet->address()};
    EXPECT_THAT(held.head(), StartsWith("HTTP/1.1 503 "));
    EXPECT_EQ(held.line().rest(), "the stream is suspended\n");
    outlet->go_on();
    EXPECT_EQ(colour_of(MediaReceiver{outlet->address()}.line().rest()), 'r');
}

TEST(HttpFilm, Answers503WithoutAPicture) {
    Stage stage;
    Screen screen;
    screen.colour = '-';
    auto const outlet = stage.server.serve(screen.film(Film::Form::jpeg), Flow::on);
    MediaReceiver receiving{outlet->address()};
    EXPECT_THAT(receiving.head(), StartsWith("HTTP/1.1 503 "));
    EXPECT_EQ(receiving.line().rest(), "there is no picture yet\n");
}

TEST(HttpFilm, CountsRequestsForPicturesAsReception) {
    Settings settings;
    settings.picture_interest = std::chrono::milliseconds{50};
    Stage stage{settings};
    Screen screen;
    auto const outlet = stage.server.serve(screen.film(Film::Form::jpeg), Flow::on);
    MediaReceiver{outlet->address()}.line().rest();
    EXPECT_EQ(next_reception(*outlet), Reception::begun);
    EXPECT_EQ(next_reception(*outlet), Reception::ended);
    MediaReceiver{outlet->address()}.line().rest();
    EXPECT_EQ(next_reception(*outlet), Reception::begun);
}

}  // namespace
}  // namespace rois::media
