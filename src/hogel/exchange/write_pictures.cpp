// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "hogel/core/output_file.h"
#include "hogel/error.h"
#include "hogel/exchange/view_set.h"

namespace hogel::exchange {
namespace {

class FileWriter final : public ViewWriter {
  public:
    FileWriter(ViewTarget target, std::function<std::string(std::size_t, std::size_t)> name)
        : target_(std::move(target)), name_(std::move(name)) {}

    std::filesystem::path write(std::size_t row, std::size_t column, const StoredView& view) override {
        std::filesystem::path path = target_.path / (name_(row, column) + "." + target_.format);
        core::write_file(path, picture_file(target_, view));
        return path;
    }

  private:
    ViewTarget target_;
    std::function<std::string(std::size_t, std::size_t)> name_;
};

// Rescales codes from the full range of 8 or 16 bits to those of a pixmap, 0 to `max`.
Array<std::uint16_t, 3> pixmap_codes(const StoredView& view, std::uint32_t max) {
    return std::visit(
        [&](const auto& samples) {
            using T = std::remove_cvref_t<decltype(samples(0, 0, 0))>;
            Array<std::uint16_t, 3> codes(samples.shape());
            if constexpr (std::is_same_v<T, float>) {
                throw Error(ErrorCode::internal, "pixmaps hold whole numbers");
            } else {
                constexpr std::uint32_t full = std::numeric_limits<T>::max();
                for (std::size_t i = 0; i < codes.size(); ++i)
                    codes.data()[i] = static_cast<std::uint16_t>((samples.data()[i] * max + full / 2) / full);
            }
            return codes;
        },
        view);
}

}  // namespace

std::vector<unsigned char> picture_file(const ViewTarget& target, const StoredView& view) {
    using namespace image;
    const Curve curve = target.transfer == Transfer::srgb ? Curve::srgb : Curve::none;
    try {
        if (target.format == "ppm")
            return pnm_file(pixmap_codes(view, (1u << target.bits) - 1), (1u << target.bits) - 1);
        if (target.format == "pfm") return pfm_file(std::get<Array<float, 3>>(view));
        if (target.format == "exr") return exr_file(std::get<Array<float, 3>>(view), target.texts);
        if (const auto* wide = std::get_if<Array<std::uint16_t, 3>>(&view))
            return png_file(wide->view(), target.texts, curve);
        return png_file(std::get<Array<std::uint8_t, 3>>(view).view(), target.texts, curve);
    } catch (const Error&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw Error(ErrorCode::cannot_write, fmt::format("{}: {}", target.path.string(), error.what()));
    }
}

std::unique_ptr<ViewWriter> file_writer(const ViewTarget& target,
                                        std::function<std::string(std::size_t, std::size_t)> name) {
    return std::make_unique<FileWriter>(target, std::move(name));
}

}  // namespace hogel::exchange
