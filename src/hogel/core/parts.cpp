// SPDX-License-Identifier: Apache-2.0
// The only source for which the build defines the available parts (CMakeLists.txt).
#include "hogel/parts.h"

#include <fmt/format.h>

#include <algorithm>

#include "hogel/core/part.h"
#include "hogel/error.h"

namespace hogel {

const std::vector<Part>& parts() {
    static const std::vector<Part> table{
        {"assimp", "mesh files", "HOGEL_ASSIMP=ON", HOGEL_ASSIMP},
        {"Draco", "packed glTF files (KHR_draco_mesh_compression)", "HOGEL_DRACO=ON", HOGEL_DRACO},
        {"meshoptimizer", "packed glTF files (EXT_meshopt_compression)", "HOGEL_MESHOPT=ON", HOGEL_MESHOPT},
        {"Embree", "rays: shadows, baking, the renderer 'raytrace'", "HOGEL_EMBREE=ON", HOGEL_EMBREE},
        {"HDF5", "light fields and holograms in HDF5 files", "HOGEL_HDF5=ON", HOGEL_HDF5},
        {"zlib", "compressed MATLAB arrays", "HOGEL_ZLIB=ON", HOGEL_ZLIB},
        {"pictures", "PNG, JPEG and OpenEXR; BMP, GIF, HDR and TGA are read", "HOGEL_PICTURES=ON", HOGEL_PICTURES},
        {"TIFF", "TIFF pictures", "HOGEL_TIFF=ON", HOGEL_TIFF},
        {"WebP", "WebP pictures", "HOGEL_WEBP=ON", HOGEL_WEBP},
        {"FFTW", "Fourier transforms by FFTW instead of hogel's own", "HOGEL_FFT=fftw", HOGEL_FFTW},
    };
    return table;
}

namespace core {

const Part& part(std::string_view name) {
    const auto found = std::ranges::find(parts(), name, &Part::name);
    if (found == parts().end()) throw Error(ErrorCode::internal, fmt::format("no optional part '{}'", name));
    return *found;
}

void refuse_without(std::string_view name, const std::string& what) {
    const Part& missing = part(name);
    throw Error(ErrorCode::not_built_in, fmt::format("{}: this build of hogel lacks {}; the build option {} brings it",
                                                     what, missing.name, missing.option));
}

void require_part(std::string_view name, const std::string& what) {
    if (!part(name).built_in) refuse_without(name, what);
}

}  // namespace core
}  // namespace hogel
