#include "database/preregistration_payload.h"

#include <nlohmann/json.hpp>

#include "protocols/files/sha256.h"

namespace database {

nlohmann::ordered_json payloadOf(const PreregistrationRecord& record)
{
    return {{"number", record.number},
            {"answers_before", record.answersBefore},
            {"after_unblinding", record.afterUnblinding},
            {"who", record.who},
            {"text_sha256", record.textSha256()},
            {"json_sha256", record.jsonSha256()},
            {"text", record.text},
            {"json", record.json}};
}

bool isPreregistration(const nlohmann::json& payload)
{
    if (!payload.is_object()) return false;
    for (const char* text : {"who", "text_sha256", "json_sha256", "text", "json"})
        if (!payload.contains(text) || !payload[text].is_string()) return false;
    for (const char* count : {"number", "answers_before"})
        if (!payload.contains(count) || !payload[count].is_number_unsigned()) return false;
    return payload.contains("after_unblinding") && payload["after_unblinding"].is_boolean();
}

std::string faultOfPreregistration(const nlohmann::json& payload, int number)
{
    if (!isPreregistration(payload)) return "the registered plan cannot be read";
    if (payload["number"] != number) return "the registered plan is not number " + std::to_string(number);
    for (const char* text : {"text", "json"})
        if (protocols::sha256(payload[text].get<std::string>()) != payload[std::string(text) + "_sha256"].get<std::string>())
            return "the registered plan does not have its own hash";
    return {};
}

}  // namespace database
