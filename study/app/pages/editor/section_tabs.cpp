#include "study/app/pages/editor/section_tabs.h"

#include <QComboBox>
#include <QPushButton>
#include <QVBoxLayout>
#include <charconv>

#include "study/app/pages/editor/draft_fields.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

namespace {

struct PlaceOfKey {
    std::string_view key;
    EditorSection section;
};
constexpr PlaceOfKey placesOfKeys[] = {{"name", EditorSection::Study},
                                       {"participants", EditorSection::Study},
                                       {"fabrics", EditorSection::Study},
                                       {"conditions", EditorSection::Conditions},
                                       {"phases", EditorSection::Questions},
                                       {"question_texts", EditorSection::Questions},
                                       {"seconds_per_presentation", EditorSection::Course},
                                       {"break_after", EditorSection::Course},
                                       {"break_after_minutes", EditorSection::Course},
                                       {"sitting_minutes", EditorSection::Course},
                                       {"familiarisation_fabrics", EditorSection::Course},
                                       {"dead_time_seconds", EditorSection::Course},
                                       {"swatches", EditorSection::Course},
                                       {"confirm_pieces", EditorSection::Course},
                                       {"second_entry", EditorSection::Course},
                                       {"language", EditorSection::Texts},
                                       {"consent", EditorSection::Texts},
                                       {"stroke_words", EditorSection::Texts},
                                       {"checklist", EditorSection::Texts},
                                       {"readings", EditorSection::Texts},
                                       {"facts", EditorSection::Texts},
                                       {"participant_texts", EditorSection::Texts},
                                       {"prompts", EditorSection::Texts},
                                       {"equivalence_bounds", EditorSection::Analysis},
                                       {"planned", EditorSection::Analysis},
                                       {"primary", EditorSection::Analysis}};

}  // namespace

EditorSection sectionOf(const std::string& place)
{
    const std::string key = place.substr(0, place.find_first_of(".["));
    for (const PlaceOfKey& row : placesOfKeys)
        if (key == row.key) return row.section;
    return EditorSection::Study;
}

std::optional<int> numberIn(const std::string& place, std::string_view before)
{
    const std::size_t at = place.find(before);
    int number = 0;
    if (at == std::string::npos) return std::nullopt;
    const char* begin = place.data() + at + before.size();
    return std::from_chars(begin, place.data() + place.size(), number).ec == std::errc() ? std::optional(number) : std::nullopt;
}

SectionTabs::SectionTabs(QWidget* parent)
    : QWidget(parent), m_list(choiceBox("sectionChoice", tr("Section of the protocol"), this))
{
    const QStringList names{tr("1  Study"),  tr("2  Conditions"), tr("3  Questions"),
                            tr("4  Course"), tr("5  Texts"),      tr("6  Analysis")};
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    auto* row = new FlowLayout(8, 6);
    for (int number = 0; number < editorSections; ++number) {
        auto* made = button(qPrintable(QStringLiteral("section%1Button").arg(number + 1)), names[number], this);
        setType(*made, Type::Plain);
        made->setCheckable(true);
        connect(made, &QPushButton::clicked, this, [this, number] { Q_EMIT chosen(static_cast<EditorSection>(number)); });
        row->addWidget(made);
        m_buttons.push_back(made);
    }
    column->addLayout(row);
    m_list->addItems(names);
    column->addWidget(m_list, 0, Qt::AlignLeft);
    connect(m_list, &QComboBox::activated, this, [this](int number) { Q_EMIT chosen(static_cast<EditorSection>(number)); });
}

void SectionTabs::setChosen(EditorSection section)
{
    const int place = static_cast<int>(section);
    m_list->setCurrentIndex(place);
    for (int number = 0; number < editorSections; ++number)
        m_buttons[static_cast<std::size_t>(number)]->setChecked(number == place);
}

void SectionTabs::setNarrow(bool isNarrow)
{
    for (QPushButton* one : m_buttons) one->setVisible(!isNarrow);
    m_list->setVisible(isNarrow);
}

LeaveGuard::LeaveGuard(QWidget* parent) : QWidget(parent), m_save(button("saveAndLeaveButton", tr("Save and leave"), this))
{
    setObjectName("leaveGuard");
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(28, 8, 28, 0);
    QLabel* question = label("guardQuestion", Type::Body, this, Weight::Bold);
    setRole(*question, "hint");
    question->setText(tr("The protocol has changes that are not saved."));
    auto* drop = button("dropChangesButton", tr("Leave without saving"), this);
    auto* stay = button("stayButton", tr("Stay (Esc)"), this);
    column->addWidget(question);
    column->addLayout(actionsRow({m_save, drop, stay}));
    connect(m_save, &QPushButton::clicked, this, &LeaveGuard::saveRequested);
    connect(drop, &QPushButton::clicked, this, &LeaveGuard::dropRequested);
    connect(stay, &QPushButton::clicked, this, &LeaveGuard::stayRequested);
    hide();
}

void LeaveGuard::ask()
{
    show();
    m_save->setFocus();
}

}  // namespace study::app
