#include "media/jpeg.hpp"

#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include <jpeglib.h>

namespace rois::media {

namespace {

constexpr int quality = 80;

// libjpeg reports errors by longjmp: objects in encode() must not have destructors.
struct Errors {
    jpeg_error_mgr manager;
    std::jmp_buf way_out;
};

void leave(j_common_ptr codec) { std::longjmp(reinterpret_cast<Errors*>(codec->err)->way_out, 1); }

struct Encoded {
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    bool whole = false;
};

void encode(Picture const& picture, Encoded& encoded) {
    jpeg_compress_struct codec{};
    Errors errors{};
    codec.err = jpeg_std_error(&errors.manager);
    errors.manager.error_exit = leave;
    if (setjmp(errors.way_out) != 0) {
        jpeg_destroy_compress(&codec);
        return;
    }
    jpeg_create_compress(&codec);
    jpeg_mem_dest(&codec, &encoded.bytes, &encoded.size);
    codec.image_width = picture.width;
    codec.image_height = picture.height;
    codec.input_components = 3;
    codec.in_color_space = JCS_RGB;
    jpeg_set_defaults(&codec);
    jpeg_set_quality(&codec, quality, TRUE);
    jpeg_start_compress(&codec, TRUE);
    while (codec.next_scanline < codec.image_height) {
        auto* row = const_cast<JSAMPLE*>(picture.rgb.data()) + std::size_t{codec.next_scanline} * picture.width * 3;
        jpeg_write_scanlines(&codec, &row, 1);
    }
    jpeg_finish_compress(&codec);
    jpeg_destroy_compress(&codec);
    encoded.whole = true;
}

}  // namespace

std::string jpeg_of(Picture const& picture) {
    if (picture.width == 0 || picture.height == 0 || picture.rgb.size() != std::size_t{picture.width} * picture.height * 3)
        throw std::invalid_argument{"the number of bytes does not fit the picture's size"};
    Encoded encoded;
    encode(picture, encoded);
    std::string text;
    if (encoded.whole) text.assign(reinterpret_cast<char const*>(encoded.bytes), encoded.size);
    std::free(encoded.bytes);
    if (!encoded.whole) throw std::runtime_error{"a picture could not be encoded"};
    return text;
}

}  // namespace rois::media
