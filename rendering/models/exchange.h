// How the program and vis2hap-nn speak: a folder with request.json and one .npy a photograph, into
// which the answers are written as answer.json and .npy files. Both sides use these functions.
//   request.json {"schema":"vis2hap.generate/1","model":FILE,"quality":"fast"|"balanced"|"accurate",
//                 "height":bool,"friction":bool,"photographs":[{"file":"photo0.npy","mm_per_pixel":X|null}]}
//   photoN.npy   uint8 [height x 3 width], R G B interleaved
//   answer.json  {"schema":"vis2hap.generated/1","signals":[{"height":FILE|null,"height_mm_per_pixel":X,
//                 "spectrogram":FILE|null,"spectrogram_parameters":{"window":N,"hop":N,"fft":N,"samples_per_mm":X},
//                 "trace":FILE|null,"trace_mm_per_sample":X,"mean_friction":X}]}
#pragma once

#include "rendering/models/generation.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rendering::models {

struct Request {
    std::vector<PhotographToTouch> photographs;
    GenerationOptions options;
};

std::string nameOf(Quality quality);
Quality qualityNamed(std::string_view name);  ///< throws badInput naming the three

void writeRequest(const std::filesystem::path& folder, std::span<const PhotographToTouch> photographs,
                  const GenerationOptions& options);
Request readRequest(const std::filesystem::path& folder);  ///< throws badInput

void writeAnswers(const std::filesystem::path& folder, std::span<const GeneratedSignals> answers);
std::vector<GeneratedSignals> readAnswers(const std::filesystem::path& folder);  ///< throws workFailed

}  // namespace rendering::models
