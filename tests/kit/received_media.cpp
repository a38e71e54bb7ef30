#include "kit/received_media.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <numbers>
#include <stdexcept>

#include <jpeglib.h>

namespace rois::kit {

namespace {

constexpr timeval patience{20, 0};

std::uint32_t number(std::string_view bytes) {
    std::uint32_t all = 0;
    for (auto const byte : bytes) all = all << 8 | static_cast<unsigned char>(byte);
    return all;
}

struct Errors {
    jpeg_error_mgr manager;
    std::jmp_buf way_out;
};

void leave(j_common_ptr codec) { std::longjmp(reinterpret_cast<Errors*>(codec->err)->way_out, 1); }

// Must not have objects with destructors: libjpeg leaves it by longjmp.
bool decode(std::string_view jpeg, Bitmap& bitmap) {
    jpeg_decompress_struct codec;
    Errors errors;
    codec.err = jpeg_std_error(&errors.manager);
    errors.manager.error_exit = leave;
    if (setjmp(errors.way_out) != 0) {
        jpeg_destroy_decompress(&codec);
        return false;
    }
    jpeg_create_decompress(&codec);
    jpeg_mem_src(&codec, reinterpret_cast<unsigned char const*>(jpeg.data()), jpeg.size());
    jpeg_read_header(&codec, TRUE);
    codec.out_color_space = JCS_RGB;
    jpeg_start_decompress(&codec);
    bitmap.width = codec.output_width;
    bitmap.height = codec.output_height;
    bitmap.rgb.resize(bitmap.width * bitmap.height * 3);
    while (codec.output_scanline < codec.output_height) {
        auto* row = &bitmap.rgb[std::size_t{codec.output_scanline} * bitmap.width * 3];
        jpeg_read_scanlines(&codec, &row, 1);
    }
    jpeg_finish_decompress(&codec);
    jpeg_destroy_decompress(&codec);
    return errors.manager.num_warnings == 0;
}

}  // namespace

MediaUrl::MediaUrl(std::string const& url) {
    static std::string const scheme = "http://";
    auto const slash = url.find('/', scheme.size());
    auto const colon = url.rfind(':', slash);
    if (!url.starts_with(scheme) || slash == url.npos)
        throw std::invalid_argument{"'" + url + "' is not a media URL: expected http://HOST[:PORT]/PATH"};
    bool const has_port = colon >= scheme.size();
    address.host = url.substr(scheme.size(), (has_port ? colon : slash) - scheme.size());
    address.port = static_cast<std::uint16_t>(has_port ? std::stoi(url.substr(colon + 1, slash - colon - 1)) : 80);
    target = url.substr(slash);
}

std::string media_request(MediaUrl const& url, std::string const& method) {
    return method + " " + url.target + " HTTP/1.1\r\nHost: " + url.address.host + "\r\n\r\n";
}

std::string MediaReceiver::next_picture() {
    static std::string const length = "Content-Length: ";
    auto const head = line_.take_until("\r\n\r\n");
    auto const at = head.find(length);
    if (at == head.npos) throw std::runtime_error{"multipart video: expected a Content-Length, got " + head};
    auto picture = line_.take(static_cast<std::size_t>(std::stoul(head.substr(at + length.size()))));
    line_.take_until("\r\n");
    return picture;
}

std::vector<std::int16_t> samples_of(std::string_view bytes, ByteOrder order) {
    std::vector<std::int16_t> samples;
    for (; bytes.size() >= 2; bytes.remove_prefix(2)) {
        auto const first = static_cast<unsigned char>(bytes[0]), second = static_cast<unsigned char>(bytes[1]);
        auto const value = order == ByteOrder::big_endian ? first << 8 | second : second << 8 | first;
        samples.push_back(static_cast<std::int16_t>(value));
    }
    return samples;
}

double share_of(double frequency, std::vector<std::int16_t> const& samples, double rate) {
    double sine = 0, cosine = 0, energy = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        double const angle = 2 * std::numbers::pi * frequency * static_cast<double>(i) / rate;
        double const sample = samples[i];
        sine += sample * std::sin(angle);
        cosine += sample * std::cos(angle);
        energy += sample * sample;
    }
    return energy == 0 ? 0 : 2 * (sine * sine + cosine * cosine) / (energy * static_cast<double>(samples.size()));
}

std::array<int, 3> Bitmap::at(int column, int row) const {
    auto const first = (static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column)) * 3;
    return {rgb.at(first), rgb.at(first + 1), rgb.at(first + 2)};
}

Bitmap decoded_jpeg(std::string_view jpeg) {
    Bitmap bitmap;
    if (!decode(jpeg, bitmap)) throw std::runtime_error{"not a JPEG"};
    return bitmap;
}

Mailbox::Mailbox() : socket_{socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)} {
    sockaddr_in here{};
    here.sin_family = AF_INET;
    here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof here;
    auto* const name = reinterpret_cast<sockaddr*>(&here);
    if (socket_ < 0 || bind(socket_, name, size) != 0 || getsockname(socket_, name, &size) != 0)
        throw LineEnded{"cannot open a UDP socket"};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    port_ = ntohs(here.sin_port);
}

Mailbox::~Mailbox() { close(socket_); }

std::string Mailbox::take() {
    std::array<char, 65'536> buffer;
    auto const size = recv(socket_, buffer.data(), buffer.size(), 0);
    if (size < 0) throw LineEnded{"no datagram received"};
    return {buffer.data(), static_cast<std::size_t>(size)};
}

RtpPacket::RtpPacket(std::string const& datagram) {
    if (datagram.size() < 12) throw std::runtime_error{"not an RTP packet"};
    std::string_view const bytes{datagram};
    auto const first = number(bytes.substr(0, 1)), second = number(bytes.substr(1, 1));
    version = first >> 6;
    marker = (second & 0x80) != 0;
    payload_type = second & 0x7F;
    sequence = static_cast<std::uint16_t>(number(bytes.substr(2, 2)));
    timestamp = number(bytes.substr(4, 4));
    ssrc = number(bytes.substr(8, 4));
    payload = datagram.substr(12 + std::size_t{4} * (first & 0x0F));
}

}  // namespace rois::kit
