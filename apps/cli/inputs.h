// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "command_line.h"
#include "hogel/pipeline.h"
#include "hogel/requests.h"
#include "session.h"

namespace hogel::cli {

// These functions resolve the options: they set chosen values and the conditions under which options act.

/// Loads a built-in scene in the size of the hologram, a mesh file or a picture, fitted to it if requested, with
/// lights.
Scene load_scene(const Session& session, const std::string& name, LightFieldParameters& options);

/// Shades the scene. With --verbose prints the memory of shadow maps.
std::shared_ptr<const ShadedScene> light_scene(const Session& session, const Scene& scene,
                                               LightFieldParameters& options);

/// Returns the light field of a scene, rendered on demand when it is read.
LightField render_light_field(const Session& session, const Scene& scene, LightFieldParameters& options);

/// Throws Error(usage) if rendering needs more memory than is available.
void require_memory(const Session& session, const LightField& rendered, const LightFieldParameters& options,
                    const Scene& scene);

/// Opens the light field of a file, or renders that of a scene on demand when it is read.
LightField open_or_render(const Session& session, const std::string& name, LightFieldParameters& options);

/// Returns HologramParameters::fitted(), and prints the new scale.
LightField fitted(const Session& session, const LightField& light_field, const HologramParameters& hologram,
                  const Modulator& modulator, bool smooth);

/// Calls FieldParameters::open_and_reconstruct() for a hologram or another program's field, and prints its notes.
Fields open_and_reconstruct(const Session& session, const std::string& name, FieldParameters& options);

/// See prepare_for_reading() in hogel/pipeline.h.
LightField prepare_for_reading(const Session& session, const LightField& light_field, std::size_t times,
                               bool with_depth);

}  // namespace hogel::cli
