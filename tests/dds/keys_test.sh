#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# nc-keys: what it makes, with which modes; what it refuses; that it overwrites nothing unless it is told to. secure_test.py uses what it makes.
set -u
keys=${NC_BINARY_DIR:?}/bin/nc-keys
[ -x "$keys" ] || { echo "skipped: nc-keys is not built"; exit 77; }
command -v openssl >/dev/null || { echo "skipped: openssl is not here"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
folder=$work/keys
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }
nc_keys() { "$keys" --folder "$folder" "$@"; }
# does COMMAND...: exit status 0; its output is in `said`.
does() {
  said=$(nc_keys "$@" 2>&1) || fail "nc-keys $*: $said"
}
# refuses TEXT COMMAND...: exit status 1, and TEXT on standard error.
refuses() {
  local text=$1 err; shift
  err=$(nc_keys "$@" 2>&1 >/dev/null)
  local got=$?
  [ "$got" = 1 ] && [[ "$err" == *"$text"* ]] || fail "(exit $got, '$err'): nc-keys $*"
}
modes() { find "$folder" -mindepth 1 -printf '%P %m %y\n' | awk -v t="$1" -v m="$2" '$NF == t && $2 != m'; }
serial() { openssl x509 -in "$folder/identities/$1/identity.pem" -noout -serial; }
later() { date -u -d "+$1 seconds" +%Y-%m-%dT%H:%M:%SZ; }
# ends_soon COMMAND...: does it with an end (in `end`) of as few seconds as this computer needs for it.
ends_soon() {
  local seconds
  for seconds in 1 3 10 30 90; do
    end=$(later $seconds)
    ! nc_keys "$@" --until "$end" >/dev/null 2>&1 || return 0
  done
  fail "$* --until $end"
}
# until_ended: waits for that end, and for the second that follows it.
until_ended() { while [ "$(date -u +%s)" -le "$(date -u -d "$end" +%s)" ]; do sleep 0.2; done; }

version=$(sed -n 's/^project(libnc VERSION \([0-9.]*\).*/\1/p' "${NC_SOURCE_DIR:?}/CMakeLists.txt")
[ "$("$keys" --version)" = "nc-keys $version" ] || fail "--version: $("$keys" --version)"
grep -q 'identity NAME --right' <<<"$("$keys" --help)" || fail "--help"
grep -q 'identity NAME --right' <<<"$(nc_keys init --help)" || fail "init --help"
[ ! -e "$folder" ] || fail "--help makes a folder"
refuses "Usage:"
refuses "there is no command 'frobnicate'" frobnicate
refuses "is not there: nc-keys init makes it" list
refuses "is not there: nc-keys init makes it" identity anna --right view
refuses "--days: must be a whole number" init --days 0
refuses "--days: must be a whole number" init --days 1.5
refuses "--until: 'soon-ish' is no time" init --until soon-ish
refuses "is past" init --until 2001-01-01
refuses "one of them" init --days 5 --until 2100-01-01
[ ! -e "$folder" ] || fail "a refusal makes a folder"

# Without openssl, which is said before anything else.
mkdir "$work/bin"
for tool in bash env date sed awk cat ls rm mkdir chmod mv flock dirname basename; do ln -s "$(command -v $tool)" "$work/bin/$tool"; done
err=$(PATH=$work/bin "$keys" --folder "$folder" init 2>&1)
[ $? = 1 ] && [[ "$err" == *"openssl is not installed"* ]] || fail "without openssl: $err"
[ ! -e "$folder" ] || fail "without openssl a folder is made"

mkdir "$work/other" && echo mine >"$work/other/file"
err=$("$keys" --folder "$work/other" init 2>&1) && fail "init in a folder of somebody else"
[[ "$err" == *"has something else in it"* ]] || fail "init in a folder of somebody else: $err"

does init --name mill
for ca in identity permissions; do
  openssl x509 -in "$folder/ca/$ca-ca.pem" -noout -text >"$work/text"
  grep -q 'CA:TRUE, pathlen:0' "$work/text" || fail "$ca-ca.pem is no authority"
  grep -q "Subject: CN = mill $ca authority" "$work/text" || fail "$ca-ca.pem: $(grep Subject: "$work/text")"
done
cmp -s "$folder/ca/identity-ca.key" "$folder/ca/permissions-ca.key" && fail "both authorities have one key"
before=$(sha256sum "$folder"/ca/*.pem "$folder"/ca/*.key)
refuses "has an authority already" init
[ "$(sha256sum "$folder"/ca/*.pem "$folder"/ca/*.key)" = "$before" ] || fail "a refused init has changed something"

does identity gateway --gateway
does identity anna --right operate --machine mill3 --machine mill4
openssl x509 -in "$folder/identities/anna/identity.pem" -noout -text >"$work/text"
grep -q 'TLS Web Client Authentication, TLS Web Server' "$work/text" && ! grep -q 'E-mail Protection' "$work/text" || fail "the certificate of anna is one for signing documents"
does identity boss --right view,setup --right maintain --days 30
for bad in "" . .. -x a/b 'a b' 'ä' "$(printf 'n%.0s' $(seq 32))" '$(id)' "a'b" 'a<b'; do
  refuses "" identity "$bad" --right view
done
refuses "is no name" identity a/b --right view
refuses "which right?" identity eve
refuses "and not 'admin'" identity eve --right admin
refuses "has no other right" identity eve --gateway --right view
refuses "--right needs a value" identity eve --right
refuses "--frob was not expected" identity eve --frob
refuses "there is no identity eve" renew eve
refuses "there is no identity eve" revoke eve
refuses "there is no identity eve" export eve "$work/eve"
refuses "renew: whom?" renew
[ ! -e "$folder/identities/eve" ] || fail "a refusal makes an identity"

# Nobody else reads any of it.
[ -z "$(modes f 600)" ] || fail "modes of files: $(modes f 600)"
[ -z "$(modes d 700)" ] && [ "$(stat -c %a "$folder")" = 700 ] || fail "modes of folders: $(modes d 700)"
leftover=$(find "$folder" -name '*.new' -o -name '*.request' -o -name '*.signed' -o -name permissions.xml)
[ -z "$leftover" ] || fail "left over: $leftover"

# The permissions: a signature of the authority, and exactly the topics of the right.
# topics NAME: "publish: ..." and "subscribe: ..." of an identity.
topics() {
  openssl smime -verify -text -in "$folder/identities/$1/permissions.p7s" -CAfile "$folder/ca/permissions-ca.pem" 2>/dev/null | tr -d '\r' |
    awk '/<(publish|subscribe)>/ { if (what) print what; gsub(/[<> ]/, ""); what = $0 ":" } /<topic>/ { gsub(/<[^>]*>| /, ""); what = what " " $0 } END { print what }'
}
# partitions NAME TOPIC: those in which an identity may use a topic.
partitions() {
  openssl smime -verify -text -in "$folder/identities/$1/permissions.p7s" -CAfile "$folder/ca/permissions-ca.pem" 2>/dev/null | tr -d '\r' |
    awk -v topic="<topic>$2</topic>" '/<(publish|subscribe)>/ { here = 0 } index($0, topic) { here = 1 } here && /<partition>/ { gsub(/<[^>]*>| /, ""); print }' | tr '\n' ' '
}
status="nc_MachineInfo nc_Status nc_Alarm nc_AlarmHistory nc_SignalTable nc_SignalImage nc_Status_v1 nc_Alarm_v1"
services="nc_ServiceView nc_ServiceOperate nc_ServiceSetUp nc_ServiceMaintain"
# has NAME PUBLISH SUBSCRIBE: topics, and nc_ServiceReply, which the gateway publishes and everybody else subscribes to.
has() {
  local replies=subscribe
  [ "$1" != gateway ] || replies=publish
  [ "$(topics "$1")" = "publish: $2
subscribe: $3
$replies: nc_ServiceReply" ] || fail "permissions of $1: $(topics "$1")"
}
has gateway "$status nc_CommandAck" "nc_Command $services"
has anna "nc_ServiceView nc_Command nc_ServiceOperate" "$status nc_CommandAck"
has boss "nc_ServiceView nc_ServiceSetUp nc_ServiceMaintain" "$status"
[ "$(partitions anna nc_ServiceReply)" = "mill3/anna mill3/anna@* mill4/anna mill4/anna@* " ] || fail "anna reads replies in $(partitions anna nc_ServiceReply)"
[ "$(partitions boss nc_ServiceReply)" = "*/boss */boss@* " ] || fail "boss reads replies in $(partitions boss nc_ServiceReply)"
[ "$(partitions gateway nc_ServiceReply)" = "*/* " ] || fail "the gateway writes replies in $(partitions gateway nc_ServiceReply)"
[ "$(partitions anna nc_ServiceOperate)" = "mill3 mill4 " ] || fail "anna operates $(partitions anna nc_ServiceOperate)"
refuses "is too long" identity "$(printf 'n%.0s' $(seq 28))" --right view
grep -q "kMostRemoteClient = $(sed -n 's/^readonly kMostClient=\([0-9]*\).*/\1/p' "$keys");" "$NC_SOURCE_DIR/runtime/services/service_table.hpp" || fail "nc-keys has another longest name of a client than the services"
grep -q '<partition>mill3</partition>' "$folder/identities/anna/permissions.p7s" && grep -q '<partition>mill4</partition>' "$folder/identities/anna/permissions.p7s" &&
  ! grep -q '<partition>\*</partition>' "$folder/identities/anna/permissions.p7s" || fail "anna is not for mill3 and mill4 alone"
grep -q '<partition>\*</partition>' "$folder/identities/boss/permissions.p7s" || fail "boss is not for all controls"
# Every topic of the IDL's documents that the gateway publishes or reads is somebody's.
for topic in $(sed -n 's/^    {Topic::k[A-Za-z]*, "\(nc_[A-Za-z0-9_]*\)".*/\1/p' "$NC_SOURCE_DIR/dds/participant.cpp"); do
  [[ " $(topics gateway | tr '\n' ' ') " == *" $topic "* ]] || fail "the gateway may not use $topic"
done
for setting in allow_unauthenticated_participants.false enable_join_access_control.true discovery_protection_kind.SIGN data_protection_kind.ENCRYPT \
  enable_read_access_control.true enable_write_access_control.true; do
  grep -q "<${setting%.*}>${setting#*.}</" "$folder/identities/anna/governance.p7s" || fail "governance: no ${setting%.*} = ${setting#*.}"
done
openssl smime -verify -text -in "$folder/identities/anna/governance.p7s" -CAfile "$folder/ca/permissions-ca.pem" >/dev/null 2>&1 || fail "the governance is not signed"

# Renewal keeps the key and the rights; a second identity of the name is asked for.
old=$(serial anna) key=$(sha256sum <"$folder/identities/anna/key.pem") rights=$(topics anna)
refuses "is there already" identity anna --right view
[ "$(serial anna)" = "$old" ] && [ "$(topics anna)" = "$rights" ] || fail "a refused identity has changed the one that was there"
signed=$(sha256sum <"$folder/identities/anna/permissions.p7s") subject=$(openssl x509 -in "$folder/identities/anna/identity.pem" -noout -subject)
does renew anna
# A process of DDS has one set of permissions: other ones cannot be taken without an interruption. They end with the authority.
[ "$(sha256sum <"$folder/identities/anna/permissions.p7s")" = "$signed" ] || fail "renew has changed the permissions"
[ "$(openssl x509 -in "$folder/identities/anna/identity.pem" -noout -subject)" = "$subject" ] || fail "renew has changed the subject"
end=$(date -u -d "$(openssl x509 -in "$folder/ca/permissions-ca.pem" -noout -enddate | cut -d= -f2)" +%Y-%m-%dT%H:%M:%SZ)
grep -q "<not_after>$end</not_after>" "$folder/identities/anna/permissions.p7s" || fail "the permissions end before their authority"
[ "$(serial anna)" != "$old" ] && [ "$(sha256sum <"$folder/identities/anna/key.pem")" = "$key" ] && [ "$(topics anna)" = "$rights" ] || fail "renew"
openssl verify -CAfile "$folder/ca/identity-ca.pem" "$folder/identities/anna/identity.pem" >/dev/null || fail "the renewed certificate"
does renew --soon
[ -z "$said" ] || fail "renew --soon renews what has a year: $said"
does renew anna --until "$(later 3600)"
grep -q '^anna .*ends soon' <<<"$(nc_keys list)" || fail "list: anna does not end soon"
does renew --soon
[[ "$said" == "anna: operate"* ]] || fail "renew --soon: $said"
does renew --all --days 20000
[[ "$said" == *"boss: only until "*"when the authority ends"* ]] || fail "a certificate outlives its authority: $said"

# list
ends_soon identity brief --right view
until_ended
nc_keys list >"$work/list"
grep -qE '^authority until [0-9-]+T' "$work/list" && grep -qE '^brief +view +[0-9TZ:-]+ +expired' "$work/list" && grep -qE '^boss +view,setup,maintain ' "$work/list" &&
  grep -qE '^anna +operate .* valid +mill3 mill4$' "$work/list" || fail "list: $(cat "$work/list")"
if command -v python3 >/dev/null; then
  nc_keys list --json | python3 -c '
import json, sys
found = {i["name"]: i for i in json.load(sys.stdin)["identities"]}
assert found["anna"]["machines"] == ["mill3", "mill4"] and found["boss"]["rights"] == ["view", "setup", "maintain"] and found["brief"]["state"] == "expired", found
' || fail "list --json"
fi

# Revocation, and a new key for a name.
does revoke anna
openssl crl -in "$folder/ca/revoked.pem" -noout -text >"$work/text"
[ "$(grep -c 'Serial Number:' "$work/text")" -ge 2 ] || fail "the renewed and the earlier certificate of anna are not both revoked"
grep -q "$(serial anna | cut -d= -f2)" "$work/text" || fail "the certificate of anna is not revoked"
cmp -s "$folder/ca/revoked.pem" "$folder/identities/gateway/revoked.pem" || fail "the gateway has not the new list"
grep -qE '^anna .* revoked' <<<"$(nc_keys list)" || fail "list: anna is not revoked"
refuses "anna is revoked" renew anna
refuses "anna is revoked" export anna "$work/of_anna"
does renew --all
[[ "$said" != *anna* ]] || fail "renew --all renews who is revoked"
does revoke anna
does identity anna --right view --force
[ "$(openssl x509 -in "$folder/identities/anna/identity.pem" -noout -subject)" != "$subject" ] || fail "the permissions that anna had before are those of her new certificate, too"
[ "$(sha256sum <"$folder/identities/anna/key.pem")" != "$key" ] || fail "identity --force has kept the key"
grep -qE '^anna +view .* valid' <<<"$(nc_keys list)" || fail "list: anna is not there again"

mv "$folder/ca/permissions-ca.key" "$work/away.key"
refuses "permissions-ca.key, is missing" renew anna
mv "$work/away.key" "$folder/ca/permissions-ca.key"

# Export: only what the name needs, for whom it is said.
does export anna "$work/anna"
[ "$(ls "$work/anna" | tr '\n' ' ')" = "governance.p7s identity-ca.pem identity.pem key.pem permissions-ca.pem permissions.p7s revoked.pem " ] || fail "export: $(ls "$work/anna")"
[ "$(stat -c %a "$work/anna" "$work/anna/key.pem" | tr '\n' ' ')" = "700 600 " ] || fail "export: modes"
does export anna "$work/anna"
refuses "is the folder of anna, not of boss" export boss "$work/anna"
refuses "has no group nosuchgroup" export boss "$work/boss" --group nosuchgroup
does export boss "$work/boss" --group "$(id -gn)"
[ "$(stat -c %a "$work/boss" "$work/boss/key.pem" | tr '\n' ' ')" = "750 640 " ] || fail "export --group: modes"

# Two at a time do not get in each other's way.
nc_keys identity one --right view >"$work/one" 2>&1 & first=$!
nc_keys identity two --right view >"$work/two" 2>&1 & second=$!
wait $first && wait $second || fail "two at a time: $(cat "$work/one" "$work/two")"
[ "$(nc_keys list | grep -cE '^(one|two) .* valid')" = 2 ] || fail "two at a time: $(nc_keys list)"

# Another authority puts the first one aside; one that has ended is named.
begin=$SECONDS
does identity timed --right view
end=$(later $((3 + 5 * (SECONDS - begin))))  # time enough for the two commands that follow
does init --name next --until "$end" --force
aside=$(echo "$folder"/before-*)
[ -f "$aside/ca/identity-ca.key" ] && [ -d "$aside/identities/anna" ] || fail "init --force has thrown something away"
does identity anna --right view
until_ended
refuses "the authority has ended at" identity boss --right view
refuses "the authority has ended at" renew anna
refuses "characters that the configuration of openssl does not take" --folder "$work/with space" init

[ $failures = 0 ] && echo "ok"
exit $((failures != 0))
