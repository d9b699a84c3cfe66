// SPDX-License-Identifier: Apache-2.0
#include <cstdio>  // before jpeglib.h, which needs FILE

#include <jpeglib.h>

#include <jerror.h>

#include <array>
#include <cmath>
#include <csetjmp>
#include <cstdlib>
#include <stdexcept>

#include "hogel/image/formats/formats.h"
#include "hogel/image/formats/row_blocks.h"

namespace hogel::image {
namespace {

// Limits the number of scans: a malicious progressive file can have thousands of them.
constexpr int max_scans = 500;

// libjpeg reports an error by calling fail_by_jump(), which must not return. As with libpng, a step that calls libjpeg
// must not own objects with destructors.
struct Errors {
    jpeg_error_mgr base;  // first, because libjpeg casts to it
    std::jmp_buf back;
    std::array<char, JMSG_LENGTH_MAX> text;
};

[[noreturn]] void fail_by_jump(j_common_ptr jpeg) {
    auto* errors = reinterpret_cast<Errors*>(jpeg->err);
    errors->base.format_message(jpeg, errors->text.data());
    std::longjmp(errors->back, 1);
}

// Treats the end of the file as an error. Other warnings report damage that libjpeg conceals.
void refuse_early_end(j_common_ptr jpeg, int level) {
    if (level < 0 && jpeg->err->msg_code == JWRN_JPEG_EOF) fail_by_jump(jpeg);
}

void print_nothing(j_common_ptr) {}

void limit_scans(j_common_ptr jpeg) {
    if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number <= max_scans) return;
    auto* errors = reinterpret_cast<Errors*>(jpeg->err);
    std::snprintf(errors->text.data(), errors->text.size(), "it has more than %d scans", max_scans);
    std::longjmp(errors->back, 1);
}

class JpegReader {
  public:
    explicit JpegReader(const PictureBytes& file) : file_(file) {
        jpeg_.err = jpeg_std_error(&errors_.base);
        errors_.base.error_exit = fail_by_jump;
        errors_.base.emit_message = refuse_early_end;
        errors_.base.output_message = print_nothing;
        errors_.text[0] = 0;
        progress_.progress_monitor = limit_scans;
        run([&] { jpeg_create_decompress(&jpeg_); });
        jpeg_.progress = &progress_;
    }
    ~JpegReader() { jpeg_destroy_decompress(&jpeg_); }
    JpegReader(const JpegReader&) = delete;
    JpegReader& operator=(const JpegReader&) = delete;

    void read_header() {
        run([&] {
            jpeg_mem_src(&jpeg_, file_.bytes.data(), static_cast<unsigned long>(file_.bytes.size()));
            jpeg_save_markers(&jpeg_, JPEG_COM, 0xffff);
            jpeg_read_header(&jpeg_, TRUE);
        });
    }

    Metadata texts() const {
        Metadata texts;
        for (const jpeg_marker_struct* marker = jpeg_.marker_list; marker != nullptr; marker = marker->next) {
            const std::string text(reinterpret_cast<const char*>(marker->data), marker->data_length);
            texts.emplace_back("ImageDescription", text.substr(0, text.find('\0')));
        }
        return texts;
    }

    Samples pixels() {
        file_.check_size(jpeg_.image_width, jpeg_.image_height, static_cast<std::uint64_t>(jpeg_.num_components), 1);
        const bool inks = jpeg_.jpeg_color_space == JCS_CMYK || jpeg_.jpeg_color_space == JCS_YCCK;
        const bool grey = jpeg_.jpeg_color_space == JCS_GRAYSCALE;
        jpeg_.out_color_space = inks ? JCS_CMYK : grey ? JCS_GRAYSCALE : JCS_RGB;
        run([&] { jpeg_start_decompress(&jpeg_); });
        const std::size_t channels = grey ? 1 : 3, width = jpeg_.output_width;
        Array<std::uint8_t, 3> samples({jpeg_.output_height, width, channels});
        std::vector<JSAMPLE> line(inks ? 4 * width : 0);
        JSAMPLE* const first = samples.data();
        JSAMPLE* const colours = line.data();
        for_row_blocks(jpeg_.output_height, width * channels, [&](std::size_t, std::size_t last) {
            run([&] {
                while (jpeg_.output_scanline < last) {
                    JSAMPLE* const row = first + jpeg_.output_scanline * width * channels;
                    JSAMPROW into = inks ? colours : row;
                    jpeg_read_scanlines(&jpeg_, &into, 1);
                    if (inks) to_rgb(colours, row, width);
                }
            });
        });
        return samples;
    }

  private:
    template <class Step>
    void run(const Step& step) {
        if (!attempt(step)) file_.fail(errors_.text.data());
    }
    template <class Step>
    bool attempt(const Step& step) {
        if (setjmp(errors_.back) != 0) return false;
        step();
        return true;
    }

    // JPEG files store inverted ink amounts.
    static void to_rgb(const JSAMPLE* inks, JSAMPLE* colours, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t c = 0; c < 3; ++c)
                colours[3 * i + c] =
                    static_cast<JSAMPLE>(std::lround(static_cast<float>(inks[4 * i + c] * inks[4 * i + 3]) / 255.0f));
    }

    const PictureBytes& file_;
    Errors errors_;
    jpeg_progress_mgr progress_{};
    jpeg_decompress_struct jpeg_{};
};

class Writer {
  public:
    Writer() {
        jpeg_.err = jpeg_std_error(&errors_.base);
        errors_.base.error_exit = fail_by_jump;
        errors_.base.output_message = print_nothing;
        errors_.text[0] = 0;
        run([&] { jpeg_create_compress(&jpeg_); });
    }
    ~Writer() {
        jpeg_destroy_compress(&jpeg_);
        std::free(file_);  // allocated by libjpeg with malloc()
    }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;

    std::vector<unsigned char> file(View<const std::uint8_t, 3> pixels, int quality) {
        const bool grey = pixels.extent(2) == 1;
        const std::size_t row = pixels.extent(1) * pixels.extent(2);
        run([&] {
            jpeg_mem_dest(&jpeg_, &file_, &bytes_);
            jpeg_.image_width = static_cast<JDIMENSION>(pixels.extent(1));
            jpeg_.image_height = static_cast<JDIMENSION>(pixels.extent(0));
            jpeg_.input_components = grey ? 1 : 3;
            jpeg_.in_color_space = grey ? JCS_GRAYSCALE : JCS_RGB;
            jpeg_set_defaults(&jpeg_);
            jpeg_set_quality(&jpeg_, quality, TRUE);
            jpeg_.dct_method = JDCT_ISLOW;
            if (!grey && quality >= full_colours)
                jpeg_.comp_info[0].h_samp_factor = jpeg_.comp_info[0].v_samp_factor = 1;
            jpeg_start_compress(&jpeg_, TRUE);
        });
        for_row_blocks(pixels.extent(0), row, [&](std::size_t, std::size_t last) {
            run([&] {
                while (jpeg_.next_scanline < last) {
                    // libjpeg does not modify the line.
                    auto* line = const_cast<JSAMPLE*>(pixels.data() + jpeg_.next_scanline * row);
                    jpeg_write_scanlines(&jpeg_, &line, 1);
                }
            });
        });
        run([&] { jpeg_finish_compress(&jpeg_); });
        return {file_, file_ + bytes_};
    }

  private:
    static constexpr int full_colours = 90;  // minimum quality for colours at full resolution

    template <class Step>
    void run(const Step& step) {
        if (!attempt(step)) throw std::runtime_error(errors_.text.data());
    }
    template <class Step>
    bool attempt(const Step& step) {
        if (setjmp(errors_.back) != 0) return false;
        step();
        return true;
    }

    Errors errors_;
    jpeg_compress_struct jpeg_{};
    unsigned char* file_ = nullptr;
    unsigned long bytes_ = 0;
};

}  // namespace

std::vector<unsigned char> jpeg_file(View<const std::uint8_t, 3> pixels, int quality) {
    return Writer().file(pixels, quality);
}

Picture read_jpeg(const PictureBytes& file) {
    JpegReader reader(file);
    reader.read_header();
    Picture picture{{}, reader.texts()};
    if (!file.only_texts) picture.samples = reader.pixels();
    return picture;
}

}  // namespace hogel::image
