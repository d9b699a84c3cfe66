// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/field.h"
#include "hogel/io/hdf5/dataset.h"
#include "hogel/light_field.h"

namespace hogel::io::hdf5 {

/// The sampling of each face of a light field, the front first, from the attributes of its "radiance". Checks
/// everything but samples. Throws Error(bad_input). Needs a Session.
std::vector<LightFieldGrid> read_light_field_grids(hid_t file, const std::filesystem::path& path);

/// The sampling of the fields of a hologram, one for each group "field<i>". Throws Error(bad_input). Needs a Session.
std::vector<FieldGrid> read_hologram_grids(hid_t file, const std::filesystem::path& path);

/// The radiance of a light field's front face, which has that grid. Needs a Session.
DatasetReader radiance_of_front(hid_t file, const LightFieldGrid& grid,
                                const std::shared_ptr<const core::RawFile>& raw);

/// The samples of a hologram's field number `field`, which has that grid. Needs a Session.
DatasetReader samples_of_field(hid_t file, std::size_t field, const FieldGrid& grid,
                               const std::shared_ptr<const core::RawFile>& raw);

}  // namespace hogel::io::hdf5
