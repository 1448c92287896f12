// JSON as a template is compiled once for all tests (headers.cpp), not again in each.
#pragma once

#include <QFloat16>  // QCOMPARE of a JSON value needs the whole class.
#include <nlohmann/json.hpp>

extern template class nlohmann::basic_json<>;
extern template class nlohmann::basic_json<nlohmann::ordered_map>;
extern template class nlohmann::detail::serializer<nlohmann::json>;
extern template class nlohmann::detail::serializer<nlohmann::ordered_json>;
