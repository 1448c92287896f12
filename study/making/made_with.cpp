#include "study/making/made_with.h"

#include <QtGlobal>
#include <nlohmann/json.hpp>
#include <opencv2/core/version.hpp>

#include "database/sqlite_connection.h"
#include "protocols/files/json_in_order.h"
#include "protocols/files/sha256.h"
#include "protocols/secrets/sealing.h"
#include "rendering/composition/render_json.h"
#include "study/records/display_response_record.h"

namespace study::making {

namespace {

using nlohmann::ordered_json;

ordered_json textOrNull(const std::string& text) { return text.empty() ? ordered_json() : ordered_json(text); }

ordered_json jsonOf(const UsedProgram& used, const NewStudy& request)
{
    return {{"program", used.program.program.filename().string()},
            {"folder", used.program.program.parent_path().string()},
            {"sha256", used.sha256},
            {"arguments", used.program.arguments},
            {"files_sha256", used.filesSha256},
            {"images_sha256", used.imagesSha256},
            {"seconds_at_most", request.programLimits.time.count()},
            {"memory_mib_at_most", request.programLimits.memoryMib}};
}

}  // namespace

std::string madeWith(const NewStudy& request, const std::string& weightsSha256, const std::map<std::string, std::string>& prompts,
                     const StudyMaterial& material)
{
    ordered_json made{{"program", request.programVersion}, {"commit", textOrNull(request.programCommit)}};
    made["compiler"] = "GCC " __VERSION__;
    made["libraries"] = {{"qt", qVersion()},
                         {"sqlite", database::sqliteVersion()},
                         {"opencv", CV_VERSION},
                         {"libsodium", protocols::sealingLibraryVersion()}};
    made["weights_sha256"] = textOrNull(weightsSha256);
    made["settings"] = {{"seed", request.seed},
                        {"key_seed_given", request.keySeed.has_value()},  // the seed itself would open the key
                        {"allow_training_samples", request.allowTrainingSamples},
                        {"even_strange", request.evenStrange},
                        // Of conditions whose id carries no quality.
                        {"quality", rendering::settingsOf(rendering::RenderRequest().generation.quality)}};
    for (const auto& [key, bytes] : prompts) made["prompts_sha256"][key] = protocols::sha256(bytes);
    if (!material.own.sha256.empty()) made["own_images_sha256"] = material.own.sha256;
    for (const UsedProgram& used : material.programs) made["programs"][used.program.condition.value] = jsonOf(used, request);
    if (!material.responseJson.empty()) made[records::displayResponseField] = protocols::jsonInOrder(material.responseJson);
    return made.dump();
}

}  // namespace study::making
