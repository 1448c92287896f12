// Files between the program and vis2hap-nn. A folder holds request.json and one .npy file for each photograph; vis2hap-nn
// adds answer.json and its .npy files. Both sides use these functions and hold one photograph at a time.
//   request.json {"schema":"vis2hap.generate/1","model":FILE,"quality":"fast"|"balanced"|"accurate",
//                 "height":bool,"friction":bool,"photographs":[{"file":"photo0.npy","mm_per_pixel":X|null,"light_deg":X|null}]}
//   photoN.npy   uint8 [height x 3 width], R G B interleaved
//   answer.json  {"schema":"vis2hap.generated/1","signals":[{"height":FILE|null,"height_mm_per_pixel":X,
//                 "spectrogram":FILE|null,"spectrogram_parameters":{"window":N,"hop":N,"fft":N,"samples_per_mm":X},
//                 "trace":FILE|null,"trace_mm_per_sample":X,"mean_friction":X,"mean_friction_interval":[LOW,HIGH]|null,
//                 "distance":X|null,"usual_distance":X,"height_ms":X,"friction_ms":X}]}
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rendering/models/generation.h"

namespace rendering::models {

struct RequestedPhotograph {
    std::filesystem::path file;
    std::optional<double> mmPerPixel = {}, lightDeg = {};
    std::optional<fabrics::Fibre> fibre = {};
};

struct GenerationRequest {
    std::vector<RequestedPhotograph> photographs;
    GenerationOptions options;
};

Quality qualityNamed(std::string_view name);  ///< throws badInput that lists the three

/// Writes each photograph when it is added, and request.json at the end.
class RequestWriter {
public:
    RequestWriter(std::filesystem::path folder, GenerationOptions options);
    void add(const InputPhotograph& photograph);
    void finish() const;

private:
    std::filesystem::path m_folder;
    GenerationOptions m_options;
    std::vector<RequestedPhotograph> m_photographs;
};

GenerationRequest readRequest(const std::filesystem::path& folder);     ///< throws badInput
InputPhotograph readPhotograph(const RequestedPhotograph& photograph);  ///< throws badInput

/// Writes the arrays of each answer when it is added, and answer.json at the end.
class AnswerWriter {
public:
    explicit AnswerWriter(std::filesystem::path folder);
    void add(const GeneratedSignals& answer);
    void finish() const;

private:
    std::filesystem::path m_folder;
    std::vector<std::string> m_signals;  ///< JSON objects
};

std::vector<GeneratedSignals> readAnswers(const std::filesystem::path& folder);  ///< throws workFailed

}  // namespace rendering::models
