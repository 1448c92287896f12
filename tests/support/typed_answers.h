// Answers typed into the window and answers stored in the study, in one form for comparison.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "database/study_store.h"
#include "tests/support/open_window.h"

namespace tests::support {

/// Text of the answer ("F02", "5.4", "same" or words) by participant, trial and question ("P01 7 Q3").
using Answers = std::map<std::string, std::string>;

std::string answerText(const study::session::GivenAnswer& response);
std::vector<database::CurrentAnswer> storedIn(const database::StudyFolder& folder);
Answers answersIn(const database::StudyFolder& folder);

/// Key in Answers of the answer that the window waits for.
std::string nowAsked(OpenWindow& open);

/// Sends keys to the widget that has the focus.
void pressKey(OpenWindow& open, Qt::Key key);
void typeText(OpenWindow& open, const QString& text);

/// Types the letter, the number (with `point` as decimal point) or the words.
void enterByKeys(OpenWindow& open, const study::session::GivenAnswer& response, QChar point = u'.');

/// Gives one answer by keys only: first touch, two seconds, entry, Enter.
void answerByKeys(OpenWindow& open, const study::session::GivenAnswer& response, QChar point = u'.');

}  // namespace tests::support
