-- The tables of one study on a PostgreSQL server, in a schema of their own. Those of the first part have the names, columns and
-- rules of database/schema.cpp. Texts in keys sort by bytes, as in SQLite, so that hashes over ordered rows are equal.

DO $$
BEGIN
    IF current_setting('server_encoding') <> 'UTF8' THEN
        RAISE EXCEPTION USING ERRCODE = 'VH301',
            MESSAGE = 'the database stores texts as ' || current_setting('server_encoding'),
            DETAIL = 'a database with the encoding UTF8', HINT = 'make one with createdb --encoding=UTF8 --template=template0';
    END IF;
END
$$;

CREATE SCHEMA @schema@;

CREATE TABLE @schema@.study(
    id bigint PRIMARY KEY CHECK (id = 1), name text NOT NULL,
    protocol_json text NOT NULL, protocol_sha256 text NOT NULL, design_seed text NOT NULL,
    key_sha256 text NOT NULL, station_key_sha256 text NOT NULL, has_passphrase bigint NOT NULL,
    dataset_path text NOT NULL, dataset_sha256 text NOT NULL, dataset_procedural bigint NOT NULL,
    model_sha256 text NOT NULL, stamps text NOT NULL, signals_json text NOT NULL, planned_balance text NOT NULL,
    created_at text NOT NULL, program_version text NOT NULL, made_with text NOT NULL);

CREATE TABLE @schema@.fabrics(
    position bigint PRIMARY KEY, id text COLLATE "C" NOT NULL UNIQUE, name text NOT NULL);

CREATE TABLE @schema@.stimuli(file_code text COLLATE "C" PRIMARY KEY, sha256 text NOT NULL);

CREATE TABLE @schema@.slots(number bigint PRIMARY KEY CHECK (number >= 1));

CREATE TABLE @schema@.trials(
    slot bigint NOT NULL REFERENCES @schema@.slots(number), number bigint NOT NULL CHECK (number >= 1),
    phase bigint NOT NULL, presentation_code text NOT NULL, alternatives text NOT NULL,
    sealed_code text COLLATE "C" NOT NULL UNIQUE,
    instruction text NOT NULL DEFAULT '', aim text NOT NULL DEFAULT '', deadline_ms bigint,
    PRIMARY KEY (slot, number));

-- position: the order of enrolment.
CREATE TABLE @schema@.participants(
    id text COLLATE "C" PRIMARY KEY, slot bigint NOT NULL REFERENCES @schema@.slots(number),
    kind text NOT NULL CHECK (kind IN ('human', 'scripted', 'simulated')),
    state text NOT NULL CHECK (state IN ('started', 'finished', 'withdrawn')),
    protocol_version bigint NOT NULL DEFAULT 1,
    position bigint GENERATED ALWAYS AS IDENTITY);
CREATE UNIQUE INDEX one_in_a_slot ON @schema@.participants(slot) WHERE state <> 'withdrawn';

CREATE TABLE @schema@.events(
    sequence bigint PRIMARY KEY, participant text COLLATE "C" NOT NULL, sitting bigint NOT NULL,
    kind text NOT NULL, places text NOT NULL, payload text NOT NULL, at_ns bigint NOT NULL, wall_time text NOT NULL,
    salt text NOT NULL, commitment text NOT NULL, previous_hash text NOT NULL, hash text COLLATE "C" NOT NULL UNIQUE);
CREATE INDEX events_of_participant ON @schema@.events(participant, sequence);

-- The columns stand in the order of database/response_columns.cpp.
CREATE TABLE @schema@.responses(
    id bigint PRIMARY KEY, event bigint NOT NULL REFERENCES @schema@.events(sequence),
    participant text COLLATE "C" NOT NULL REFERENCES @schema@.participants(id), trial bigint NOT NULL, attempt bigint NOT NULL,
    question text COLLATE "C" NOT NULL, presentation_code text NOT NULL, alternatives text NOT NULL, choice text,
    rating_tenths bigint, ready_at bigint NOT NULL, touched_at bigint, answered_at bigint NOT NULL, stored_at bigint NOT NULL,
    is_correction bigint NOT NULL, touched_by text, touch_ended_at bigint, answer_begun_at bigint, answer_begun_by text,
    entries bigint,
    CHECK ((choice IS NULL) <> (rating_tenths IS NULL)));
CREATE INDEX responses_of_question ON @schema@.responses(participant, trial, attempt, question, id);
CREATE UNIQUE INDEX one_first_answer ON @schema@.responses(participant, trial, attempt, question) WHERE is_correction = 0;

CREATE TABLE @schema@.voids(
    event bigint NOT NULL REFERENCES @schema@.events(sequence),
    participant text COLLATE "C" NOT NULL REFERENCES @schema@.participants(id), trial bigint NOT NULL, attempt bigint NOT NULL,
    position bigint GENERATED ALWAYS AS IDENTITY,
    PRIMARY KEY (participant, trial, attempt));

CREATE TABLE @schema@.notes(
    id bigint PRIMARY KEY, event bigint NOT NULL REFERENCES @schema@.events(sequence),
    participant text COLLATE "C" NOT NULL REFERENCES @schema@.participants(id), trial bigint NOT NULL, attempt bigint NOT NULL,
    question text, text text NOT NULL, is_flag bigint NOT NULL DEFAULT 0);
CREATE INDEX notes_of_trial ON @schema@.notes(participant, trial, attempt);

CREATE TABLE @schema@.finger_samples(
    id bigint PRIMARY KEY, event bigint NOT NULL REFERENCES @schema@.events(sequence),
    participant text COLLATE "C" NOT NULL REFERENCES @schema@.participants(id), trial bigint NOT NULL, attempt bigint NOT NULL,
    began_at bigint NOT NULL, count bigint NOT NULL, left_out bigint NOT NULL, samples text NOT NULL);
CREATE INDEX finger_samples_of_trial ON @schema@.finger_samples(participant, trial, attempt);

CREATE TABLE @schema@.unblindings(
    event bigint PRIMARY KEY REFERENCES @schema@.events(sequence), who text NOT NULL, why text NOT NULL,
    wall_time text NOT NULL);

CREATE TABLE @schema@.participant_facts(
    participant text COLLATE "C" NOT NULL REFERENCES @schema@.participants(id), fact text COLLATE "C" NOT NULL,
    value text NOT NULL, salt text NOT NULL DEFAULT '', PRIMARY KEY (participant, fact));

CREATE TABLE @schema@.swatches(
    slot bigint NOT NULL REFERENCES @schema@.slots(number), fabric text COLLATE "C" NOT NULL REFERENCES @schema@.fabrics(id),
    code text NOT NULL, PRIMARY KEY (slot, fabric));

CREATE TABLE @schema@.familiarisation(position bigint PRIMARY KEY, name text NOT NULL, sealed_code text NOT NULL);

CREATE TABLE @schema@.protocol_versions(
    version bigint PRIMARY KEY CHECK (version >= 2), event bigint NOT NULL REFERENCES @schema@.events(sequence),
    json text NOT NULL, sha256 text NOT NULL, who text NOT NULL, why text NOT NULL, wall_time text NOT NULL);

CREATE TABLE @schema@.erasures(
    event bigint PRIMARY KEY REFERENCES @schema@.events(sequence), participant text COLLATE "C" NOT NULL,
    answers_too bigint NOT NULL, who text NOT NULL, why text NOT NULL, wall_time text NOT NULL);

CREATE TABLE @schema@.acts(
    number bigint PRIMARY KEY, kind text NOT NULL, details text NOT NULL, wall_time text NOT NULL,
    previous_hash text NOT NULL, hash text COLLATE "C" NOT NULL UNIQUE);

-- The tables below exist on a server only.

-- phase_questions: for each protocol version a list of phases, each the list of its question ids.
CREATE TABLE @schema@.server_study(
    id int PRIMARY KEY CHECK (id = 1), state text NOT NULL CHECK (state IN ('arriving', 'open', 'leaving')),
    program text NOT NULL, format int NOT NULL, phase_questions jsonb NOT NULL,
    images_to text NOT NULL DEFAULT 'station' CHECK (images_to IN ('station', 'display')));

-- Each image is sealed under a key of its own, which presentation() gives out with it.
CREATE TABLE @schema@.server_images(
    file_code text COLLATE "C" PRIMARY KEY, sealed bytea NOT NULL, key text NOT NULL);
-- Sealed bytes do not compress.
ALTER TABLE @schema@.server_images ALTER COLUMN sealed SET STORAGE EXTERNAL;

CREATE TABLE @schema@.server_trials(
    slot bigint NOT NULL, number bigint NOT NULL,
    file_code text COLLATE "C" NOT NULL REFERENCES @schema@.server_images(file_code),
    PRIMARY KEY (slot, number), FOREIGN KEY (slot, number) REFERENCES @schema@.trials(slot, number));

CREATE TABLE @schema@.server_familiarisation(
    position bigint PRIMARY KEY REFERENCES @schema@.familiarisation(position),
    file_code text COLLATE "C" NOT NULL REFERENCES @schema@.server_images(file_code));

-- Every time that an image and its key left the server, or a ticket for them. A login of the role display fetches the image
-- of a ticket (released_image()); server_fetches records it.
CREATE TABLE @schema@.server_releases(
    number bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY, participant text COLLATE "C" NOT NULL, slot bigint NOT NULL,
    trial bigint NOT NULL, attempt bigint NOT NULL, login text NOT NULL, station text NOT NULL, ticket text UNIQUE,
    at timestamptz NOT NULL DEFAULT clock_timestamp());
CREATE INDEX releases_of_participant ON @schema@.server_releases(participant, trial);
CREATE INDEX releases_of_station ON @schema@.server_releases(station, number);
CREATE TABLE @schema@.server_fetches(
    number bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY, release bigint NOT NULL, login text NOT NULL,
    at timestamptz NOT NULL DEFAULT clock_timestamp());

-- token: proves that a new connection is the same station. sign: the advisory lock that the station's connection holds as long as it lives.
CREATE TABLE @schema@.server_stations(
    station text COLLATE "C" PRIMARY KEY, token text NOT NULL, login text NOT NULL, pid int NOT NULL,
    sign bigint NOT NULL,
    participant text COLLATE "C" UNIQUE, queue_length bigint NOT NULL DEFAULT 0, program text NOT NULL,
    last_seen timestamptz NOT NULL DEFAULT clock_timestamp());

-- Answers that may still wait at a station, where the connection that ended with them has lost its row above: the station joined
-- anew, or another one has its name or its participant now. They stay until the station of the token says that nothing waits, or
-- another station stores an entry of the participant. participant: empty where the station had none.
CREATE TABLE @schema@.server_owed(
    token text NOT NULL, participant text COLLATE "C" NOT NULL, station text COLLATE "C" NOT NULL, login text NOT NULL,
    queue_length bigint NOT NULL, PRIMARY KEY (token, participant));

-- Which entries of stations are stored, so that one that is sent again is not stored again.
CREATE TABLE @schema@.server_received(
    id uuid PRIMARY KEY, participant text COLLATE "C" NOT NULL, event bigint NOT NULL, station text NOT NULL,
    login text NOT NULL, at timestamptz NOT NULL DEFAULT clock_timestamp());

-- What the owner has let go on: the slot of a participant who withdrew, or the list of one with voids in a row up to this event.
CREATE TABLE @schema@.server_cleared(
    number bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY, participant text COLLATE "C" NOT NULL, state text NOT NULL,
    event bigint NOT NULL, login text NOT NULL, at timestamptz NOT NULL DEFAULT clock_timestamp());

CREATE FUNCTION @schema@.server_refuse_change() RETURNS trigger LANGUAGE plpgsql
    SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    RAISE EXCEPTION USING ERRCODE = 'VH210', MESSAGE = TG_TABLE_NAME || ' is append-only';
END
$$;
REVOKE ALL ON FUNCTION @schema@.server_refuse_change() FROM PUBLIC;

DO $$
DECLARE
    name text;
    change text;
BEGIN
    FOREACH name IN ARRAY ARRAY[
        'study', 'fabrics', 'stimuli', 'slots', 'trials', 'events', 'responses', 'voids', 'notes', 'finger_samples',
        'unblindings', 'swatches', 'familiarisation', 'protocol_versions', 'erasures', 'acts',
        'server_images', 'server_trials', 'server_familiarisation', 'server_releases', 'server_fetches', 'server_received',
        'server_cleared']
    LOOP
        FOREACH change IN ARRAY ARRAY['update', 'delete', 'truncate'] LOOP
            EXECUTE format('CREATE TRIGGER %I BEFORE %s ON @schema@.%I FOR EACH STATEMENT '
                           'EXECUTE FUNCTION @schema@.server_refuse_change()', name || '_no_' || change, change, name);
        END LOOP;
    END LOOP;
END
$$;
