-- The groups of a study's logins. They cannot log in; a lab grants them to logins of its own, one for each station. Run as often
-- as wanted. Groups belong to the whole server, but a study to one database of it.

DO $$
DECLARE
    name text;
    its_group oid;
    member text;
    members text;
BEGIN
    FOREACH name IN ARRAY ARRAY['@prefix@_experimenter', '@prefix@_monitor', '@prefix@_analyst', '@prefix@_display'] LOOP
        SELECT r.oid INTO its_group FROM pg_catalog.pg_roles r WHERE r.rolname = name;
        IF NOT FOUND THEN
            BEGIN
                EXECUTE format('CREATE ROLE %I NOLOGIN', name);
            EXCEPTION
                WHEN insufficient_privilege THEN
                    RAISE EXCEPTION USING ERRCODE = 'VH301', MESSAGE = 'your login cannot make the groups of the study',
                        DETAIL = 'a login with CREATEROLE', HINT = 'ask the administrator of the server';
            END;
            CONTINUE;
        END IF;
        -- A group that has rights here is that of this study, or of a copy of it in another database.
        CONTINUE WHEN EXISTS (SELECT FROM pg_catalog.pg_namespace n, pg_catalog.aclexplode(n.nspacl) a
                              WHERE n.oid = '@schema@'::pg_catalog.regnamespace AND a.grantee = its_group);
        IF EXISTS (SELECT FROM pg_catalog.pg_shdepend d
                   WHERE d.refclassid = 'pg_catalog.pg_authid'::pg_catalog.regclass AND d.refobjid = its_group
                     AND d.dbid NOT IN (0, (SELECT b.oid FROM pg_catalog.pg_database b
                                            WHERE b.datname = current_database()))) THEN
            RAISE EXCEPTION USING ERRCODE = 'VH303',
                MESSAGE = 'another database of this server has a study of this name, and its logins could enter this one',
                DETAIL = 'a name of its own for each study of a server',
                HINT = 'move this study back, then to an address with another study=NAME';
        END IF;
        -- Else it is left over from an earlier study: its members are not those of this one.
        SELECT string_agg(m.member::pg_catalog.regrole::text, ', ' ORDER BY m.member::pg_catalog.regrole::text) INTO members
        FROM pg_catalog.pg_auth_members m WHERE m.roleid = its_group;
        FOR member IN SELECT m.rolname FROM pg_catalog.pg_auth_members a JOIN pg_catalog.pg_roles m ON m.oid = a.member
                      WHERE a.roleid = its_group LOOP
            BEGIN
                EXECUTE format('REVOKE %I FROM %I', name, member);
            EXCEPTION
                WHEN insufficient_privilege THEN
                    RAISE EXCEPTION USING ERRCODE = 'VH303',
                        MESSAGE = 'the group ' || name || ' is left over from an earlier study, with members: ' || members,
                        DETAIL = 'a group without members',
                        HINT = 'ask the administrator of the server to revoke these members and run this again; then grant the role';
            END;
        END LOOP;
    END LOOP;
END
$$;

REVOKE ALL ON SCHEMA @schema@ FROM PUBLIC;
REVOKE ALL ON ALL TABLES IN SCHEMA @schema@ FROM PUBLIC, "@prefix@_experimenter", "@prefix@_monitor", "@prefix@_analyst", "@prefix@_display";
REVOKE ALL ON ALL SEQUENCES IN SCHEMA @schema@ FROM PUBLIC, "@prefix@_experimenter", "@prefix@_monitor", "@prefix@_analyst", "@prefix@_display";
REVOKE ALL ON ALL FUNCTIONS IN SCHEMA @schema@ FROM PUBLIC, "@prefix@_experimenter", "@prefix@_monitor", "@prefix@_analyst", "@prefix@_display";
REVOKE ALL ON SCHEMA @schema@ FROM "@prefix@_experimenter", "@prefix@_monitor", "@prefix@_analyst", "@prefix@_display";

GRANT USAGE ON SCHEMA @schema@ TO "@prefix@_experimenter", "@prefix@_monitor", "@prefix@_analyst", "@prefix@_display";

GRANT EXECUTE ON FUNCTION
    @schema@.join_study(text, text, text), @schema@.overview(), @schema@.claim(text, text), @schema@.presentation(int),
    @schema@.presented_image(text), @schema@.familiarisation_image(int), @schema@.store(jsonb), @schema@.sign_of_life(int),
    @schema@.leave(), @schema@.record_latency(text, text)
    TO "@prefix@_experimenter";

GRANT EXECUTE ON FUNCTION @schema@.released_image(text) TO "@prefix@_display";

GRANT EXECUTE ON FUNCTION @schema@.progress() TO "@prefix@_monitor", "@prefix@_analyst";

GRANT EXECUTE ON FUNCTION @schema@.record_act(text, text, text) TO "@prefix@_analyst";
GRANT SELECT ON
    @schema@.study, @schema@.fabrics, @schema@.stimuli, @schema@.slots, @schema@.trials, @schema@.participants, @schema@.events,
    @schema@.responses, @schema@.voids, @schema@.notes, @schema@.finger_samples, @schema@.unblindings, @schema@.swatches,
    @schema@.familiarisation, @schema@.protocol_versions, @schema@.erasures, @schema@.acts
    TO "@prefix@_analyst";
