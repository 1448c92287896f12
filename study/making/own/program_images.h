// Friction images that programs of the lab make, each from one photograph. A program runs before keys and running orders are
// drawn, with limits, and gets nothing but the photograph.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "rendering/composition/render_fabrics.h"
#include "rendering/fabrics/dataset.h"
#include "study/making/own/own_images.h"
#include "study/making/own/own_program.h"

namespace study::making {

/// What a study records of a program.
struct UsedProgram {
    OwnProgram program;
    std::string sha256;                              ///< of the program's file
    std::map<std::string, std::string> filesSha256;  ///< of arguments that name files, such as a script
    std::string imagesSha256;                        ///< over the images that it gave
};

struct ProgramImages {
    OwnImages own;
    std::vector<UsedProgram> used;
};

/// Runs each program once a fabric, in the order of `fabrics`: `PROGRAM ARGUMENTS... PHOTOGRAPH IMAGE`. PHOTOGRAPH is an RGB PNG
/// in a temporary folder, beside the same picture as photograph.ppm. The program writes IMAGE, an 8-bit grey PNG or binary PGM
/// of the display's size. `samples`: the photograph of each fabric. Throws workFailed, naming program and fabric, where it fails.
ProgramImages imagesOfPrograms(const std::vector<OwnProgram>& programs, const rendering::fabrics::Dataset& dataset,
                               const std::vector<protocols::FabricId>& fabrics,
                               const std::map<protocols::FabricId, rendering::SampleChoice>& samples, const ProgramLimits& limits,
                               const std::function<void(const std::string& stage, int done, int total)>& progress = {});

}  // namespace study::making
