// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/field.h"
#include "hogel/io/hdf5/dataset.h"
#include "hogel/light_field.h"

namespace hogel::io::hdf5 {

/// The sampling of each face of a light field, the front first, from the attributes of its "radiance". Checks all that
/// can be known without reading samples. Needs a Session.
std::vector<LightFieldGrid> read_light_field_grids(hid_t file, const std::filesystem::path& path);

/// The same for the fields of a hologram, one for each group "field<i>".
std::vector<FieldGrid> read_hologram_grids(hid_t file, const std::filesystem::path& path);

/// The samples of a hologram's field number `field`, which has that grid.
DatasetReader samples_of_field(hid_t file, std::size_t field, const FieldGrid& grid,
                               const std::shared_ptr<const core::RawFile>& raw);

}  // namespace hogel::io::hdf5
