// The members of a JSON file, each made when its turn comes. So the tree of a large file is never held as a whole: a study of 200
// conditions has 160,000 claims.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "reports/json/json_fields.h"

namespace reports {

using TakeRow = std::function<void(Json)>;
using TakeText = std::function<void(std::string_view)>;

using MakeValue = std::function<Json()>;
/// Makes the rows of an array, in their order.
using MakeRows = std::function<void(const TakeRow&)>;

struct JsonMember {
    std::string key;
    std::variant<MakeValue, MakeRows> content;
};

/// Several small members that are made together; the reasons in their "why" join those of the whole object.
struct JsonMembers {
    MakeValue make;  ///< an object
};

using JsonParts = std::vector<std::variant<JsonMember, JsonMembers>>;

/// The array of the rows.
Json arrayOf(const MakeRows& rows);

/// The parts as one object, "why" last.
Json objectOf(const JsonParts& parts);

/// Gives the text of the object piece by piece: the same characters as dump(2), and a line end.
void writeObject(const JsonParts& parts, const TakeText& take);

}  // namespace reports
