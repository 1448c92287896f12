// The inputs of a new study: protocol, data set, fabrics, samples and model. All are read or drawn before rendering, so that an
// impossible request is refused at once.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "protocols/protocol.h"
#include "rendering/composition/render_fabrics.h"
#include "rendering/models/model_card_fields.h"
#include "study/making/new_study.h"
#include "study/making/own/own_images.h"
#include "study/making/own/program_images.h"

namespace study::making {

struct StudyMaterial {
    std::string protocolJson;  ///< the text that is kept and hashed
    protocols::Protocol protocol;
    rendering::fabrics::Dataset dataset;
    std::vector<protocols::FabricId> fabrics;
    std::optional<rendering::models::ModelCardFields> model;  ///< none where no condition needs generated signals
    std::filesystem::path control;                            ///< weights of the L1-only control; empty where there are none
    rendering::RenderRequest render;                          ///< the rendered conditions over the fabrics, with their samples
    OwnImages own;                                            ///< images of the lab's own conditions
    std::vector<UsedProgram> programs;                        ///< that made some of them
    std::string responseJson;                                 ///< the response that `render` maps through; empty without one
    std::vector<std::string> stamps;                          ///< sentences that every report must carry
};

/// Reads the protocol and the list of fabrics only. Throws badInput as materialFor().
void requireMaterial(const NewStudy& request);

/// Throws badInput: a protocol with faults, a data set with too few fabrics or without a needed signal, only samples that
/// the model was trained on.
StudyMaterial materialFor(const NewStudy& request);

/// Runs the programs of the request and adds their images, with a stamp for each.
void addProgramImages(const NewStudy& request, StudyMaterial& material,
                      const std::function<void(const std::string& stage, int done, int total)>& progress);

/// SHA-256 over the data set; the request's cache remembers the hashes of its files.
std::string hashOfDataset(const NewStudy& request, const rendering::fabrics::Dataset& dataset);

}  // namespace study::making
