// SPDX-License-Identifier: Apache-2.0
// Pictures.
#include "hogel/image.h"

#include <algorithm>

#include "arrays.h"
#include "core.h"

namespace hogel::python {
namespace {

using py::arg;

// Creates a picture with a copy of the pixels.
std::shared_ptr<Image> image_of(const py::array_t<float, py::array::c_style>& pixels) {
    const Shape<3> shape = shape_of<3>(pixels, "pixels");
    if (shape[2] != 1 && shape[2] != 3)
        throw Error(ErrorCode::usage, "pixels",
                    "pixels: expected an array [y][x][c] of one or three channels, not of " + std::to_string(shape[2]));
    auto image = std::make_shared<Image>(shape[1], shape[0], shape[2]);
    std::copy_n(pixels.data(), image->pixels.size(), image->pixels.data());
    return image;
}

}  // namespace

py::dict dictionary_of(const ImageComparison& comparison) {
    py::dict facts;
    facts["psnr"] = comparison.psnr;
    facts["ssim"] = comparison.ssim;
    facts["max_error"] = comparison.max_error;
    facts["linear_psnr"] = comparison.linear_psnr;
    return facts;
}

void add_images(py::module_& module) {
    py::class_<Image, std::shared_ptr<Image>>(module, "Image")
        .def(py::init(&image_of), arg("pixels"))
        .def_property_readonly("width", &Image::width)
        .def_property_readonly("height", &Image::height)
        .def_property_readonly("channels", &Image::channels)
        .def_property_readonly("pixels",
                               [](const std::shared_ptr<Image>& image) {
                                   return array_over(image->pixels.data(), image->pixels.shape(), py::cast(image));
                               })
        .def_property_readonly("metadata", [](const Image& image) { return image.provenance.entries; })
        .def_property_readonly("camera", [](const Image& image) { return image.provenance.camera; });
    module.def(
        "read_image",
        [](const std::filesystem::path& path, std::size_t max_pixels) {
            return run_for(py::none(), [&](const Progress&) { return read_image(path, max_pixels); });
        },
        arg("path"), arg("max_pixels") = std::size_t{1} << 28);
    module.def(
        "write_image",
        [](const std::filesystem::path& path, const Image& image, double exposure, const py::object& metadata) {
            const Metadata entries = metadata_of(metadata);
            run(py::none(), [&](const Progress&) { write_image(path, image, exposure, entries); });
        },
        arg("path"), arg("image"), arg("exposure"), arg("metadata"));
    module.def("require_picture_name", &require_picture_name, arg("path"));
    module.def(
        "encode_png",
        [](const Image& image, double exposure) {
            const std::vector<unsigned char> png = [&] {
                const py::gil_scoped_release release;
                return encode_png(image, exposure);
            }();
            return py::bytes(reinterpret_cast<const char*>(png.data()), png.size());
        },
        arg("image"), arg("exposure"));
    module.def(
        "encode_jpeg",
        [](const Image& image, double exposure, int quality) {
            const std::vector<unsigned char> jpeg = [&] {
                const py::gil_scoped_release release;
                return encode_jpeg(image, exposure, quality);
            }();
            return py::bytes(reinterpret_cast<const char*>(jpeg.data()), jpeg.size());
        },
        arg("image"), arg("exposure"), arg("quality") = 90);
    module.def(
        "decode_image",
        [](const py::bytes& bytes, const std::string& name) {
            const auto text = static_cast<std::string_view>(bytes);
            return decode_image({reinterpret_cast<const unsigned char*>(text.data()), text.size()}, name);
        },
        arg("bytes"), arg("name"));
    module.def("read_metadata", &read_metadata, arg("path"));
    module.def("automatic_exposure", &automatic_exposure, arg("image"), py::call_guard<py::gil_scoped_release>());
    module.def(
        "compare_images",
        [](const Image& a, const Image& b, double exposure) { return dictionary_of(compare(a, b, exposure)); },
        arg("a"), arg("b"), arg("exposure"));
    module.def("srgb_encode", &srgb_encode, arg("linear"));
    module.def("srgb_decode", &srgb_decode, arg("display"));
}

}  // namespace hogel::python
