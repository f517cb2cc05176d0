#!/usr/bin/env bash
# Each kind of file that light is computed from, damaged in thirteen ways: the result is that of the whole file, or an error or a warning
# that names the file; never a crash, a number that is none, or zeros without a word. And units and places that cannot be.
. "$2/tests/lighting/checks.sh.inc"
source_tree=$2

printf 'void plastic grey 0 0 5 .5 .5 .5 0 0\ngrey polygon floor 0 0 12\n0 0 0\n4 0 0\n4 4 0\n0 4 0\n' >room.rad
printf '1 1 .8 0 0 1\n2 2 .8 0 0 1\n3 1 .8 0 0 1\n' >desk.pts
printf 'x,y,z,nx,ny,nz\n1,1,.8,0,0,1\n2,2,.8,0,0,1\n' >desk.csv
printf 'IESNA:LM-63-1995\nTILT=NONE\n1 1000 1 3 1 1 2 0 0 0 1 1 9\n0 45 90\n0\n1000 500 10\n' >lamp.ies
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nf 1 2 3 4\nf 1 5 6 2\n' >mesh.obj
printf 'solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nfacet normal 0 1 0\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nvertex 1 0 0\nendloop\nendfacet\nendsolid a\n' >mesh.stl
printf 'T two\nF 3\nV 1 0 0 0\nV 2 1 0 0\nV 3 0 1 0\nV 4 0 0 1\nS 1 1 2 3 0 0 0 .9 a\nS 2 1 4 2 0 0 0 .9 b\nEnd of data\n' >mesh.vs3
printf 'row,emittance,temperature\n*,.9,300\n1,.5,350\n' >walls.csv
bash "$source_tree/scripts/weather.sh" | head -56 >days.epw
{
  printf 'place Nowhere\nlatitude 48\nlongitude -11\ntime_zone -15\nsite_elevation 100\nweather_data_file_units 1\n'
  awk 'BEGIN { for (d = 1; d <= 2; ++d) for (h = 1; h <= 24; ++h) { s = sin(3.14159265 * (h - 8.5) / 8); print 6, d, h - .5, int(s > 0 ? 500 * s : 0), int(s > 0 ? 100 * s : 0) } }'
} >days.wea
awk 'BEGIN { for (h = 0; h < 48; ++h) print (h % 24 > 8) }' >hours.csv
{
  printf '000001,"Nowhere",XX,1,48,11,100\nDate (MM/DD/YYYY),Time (HH:MM),ETR (W/m^2),ETRN (W/m^2),GHI (W/m^2),GHI source,GHI uncert (%%),DNI (W/m^2),DNI source,DNI uncert (%%),DHI (W/m^2)\n'
  awk -F, 'NR > 8 { printf "%02d/%02d/1990,%02d:00,0,0,%s,1,0,%s,1,0,%s", $2, $3, $4, $14, $15, $16; for (i = 11; i < 34; ++i) printf ",0"; print ",5" }' days.epw
} >days.csv
awk 'BEGIN { print "Maker\n1\n1\n1\n0\n3\n45\nreport\nlamp\n1\nlamp.ldt\n2026\n600\n600\n80\n500\n500\n0\n0\n0\n0\n100\n100\n1\n0\n1\n1\nLED\n1000\n3000\n80\n10"
  for (i = 0; i < 10; ++i) print ".5"
  print "0\n0\n45\n90\n300\n200\n50" }' >lamp.ldt
printf '# gensky\nvoid brightfunc skyfunc\n2 skybr skybright.cal\n0\n7 1 5.0 1.5 0.4 0.1 -0.5 0.8\nskyfunc glow g 0 0 4 1 1 1 0\ng source s 0 0 4 0 0 1 180\n' >clear.sky
printf '# front\nVIEW= -vtv -vp 1 1 .5 -vd 0 1 0 -vu 0 0 1 -vh 60 -vv 60\n' >front.vf

# evaluate FILE: the command that reads the file of this kind, with the others whole; its numbers go to `result`.
evaluate() {
  local year="irradiance room.rad --sensors desk.pts -n 16 --to csv --weather"
  case $kind in
    room.rad) "$aureole" irradiance "$1" --sky uniform --sensors desk.pts -n 16 ;;
    desk.*) "$aureole" irradiance room.rad --sky uniform --sensors "$1" -n 16 ;;
    lamp.*) "$aureole" irradiance room.rad --lamp "$1@2,2,3" --sensors desk.pts -n 16 ;;
    clear.sky) "$aureole" irradiance "$1" room.rad --sensors desk.pts -n 16 ;;
    front.vf) "$aureole" render -q clear.sky room.rad "$1" --width 4 --samples 1 -o image.pfm && cat image.pfm ;;
    days.*) "$aureole" $year "$1" ;;
    hours.csv) "$aureole" $year days.epw --schedule "$1" ;;
    walls.csv) "$aureole" viewfactors mesh.obj --rays 64 --surfaces "$1" ;;
    *) "$aureole" viewfactors --rays 64 --to csv "$1" ;;
  esac >result 2>said
}

damage() { # HOW FILE TARGET
  local size
  size=$(wc -c <"$2")
  case $1 in
    empty) : >"$3" ;;
    half) head -c $((size / 2)) "$2" >"$3" ;;
    tail) tail -c $((size / 2)) "$2" >"$3" ;;
    zeros) { head -c $((size / 2)) "$2"; head -c 16 /dev/zero; tail -c $((size / 2)) "$2"; } >"$3" ;;
    noise) { head -c $((size / 2)) "$2"; printf '\377\376\001\002\200\300'; tail -c +$((size / 2 + 6)) "$2"; } >"$3" ;;
    letter) sed '$s/[0-9]/x/' "$2" >"$3" ;;
    huge) sed '$s/[0-9][0-9.]*/1e999/' "$2" >"$3" ;;
    nan) sed '$s/[0-9][0-9.]*/nan/' "$2" >"$3" ;;
    windows) { printf '\357\273\277'; sed 's/$/\r/' "$2"; } >"$3" ;;
    columns) sed 's/[ ,\t][^ ,\t]*$//' "$2" >"$3" ;;
    counts) sed 's/\<[2-9]\>/4000000000/' "$2" >"$3" ;;
    order) tac "$2" >"$3" ;;
    words) printf 'This is a letter and no file of numbers.\n' >"$3" ;;
  esac
}

for kind in room.rad desk.pts desk.csv lamp.ies lamp.ldt clear.sky front.vf mesh.obj mesh.stl mesh.vs3 walls.csv days.epw days.wea days.csv hours.csv; do
  evaluate $kind || fail "$kind: $(cat said)"
  mv result whole
  mkdir -p bad
  for how in empty half tail zeros noise letter huge nan windows words columns counts order; do
    damage $how $kind "bad/$kind"
    evaluate "bad/$kind"
    status=$?
    if [ $status = 0 ]; then
      ! grep -qiE '(^|,)-?(nan|inf)' result || fail "$kind, $how: numbers that are none: $(cat result)"
      case $kind,$how in desk.*,order | front.vf,counts) continue ;; esac # the same sensors, another view
      cmp -s result whole || [ $how = half ] || [ $how = tail ] || [ -s said ] || fail "$kind, $how: another result without a word"
    elif [ $status != 2 ]; then
      fail "$kind, $how: status $status: $(cat said)"
    else # walls without temperatures are whole, and emit nothing
      grep -qF "bad/$kind" said || [ $kind,$how = walls.csv,columns ] || fail "$kind, $how: the file is not named: $(cat said)"
    fi
  done
done

# --- units and places
warned() { # TEXT ARGUMENTS...
  local text=$1
  shift
  "$aureole" "$@" >/dev/null 2>said || fail "$*: $(cat said)"
  grep -qF -- "$text" said || fail "$*: '$text' is not in: $(cat said)"
}
sed 's/4/4000/g' room.rad >mm.rad
warned "check the units of the scene" irradiance mm.rad --lamp lamp.ies@2,2,3 --sensors desk.pts -n 16
refused "a larger spacing expected" irradiance mm.rad --grid floor:.5@.8 --sky uniform -n 16
warned "is in the sea" irradiance room.rad --sky cie-clear --date 2026-06-21T12:00 --location 0,0,0 --sensors desk.pts -n 16
sed '1s/48\.0000,11\.0000/0.0000,0.0000/' days.epw >sea.epw
warned "in the sea: the file has no location" irradiance room.rad --weather sea.epw --sensors desk.pts -n 16
awk -F, -v OFS=, 'NR > 8 { $14 = $15 = $16 = 0 } 1' days.epw >dark.epw
warned "see no light at all" irradiance room.rad --weather dark.epw --sensors desk.pts -n 16
sed '$s/.*/0 0 0/' lamp.ies >dark.ies
printf "1000 2000 800 0 0 1\n" >mm.pts
warned "mm.pts:1: 1 of 1 sensors are more than ten times the size of the scene away" irradiance room.rad --sky uniform --sensors mm.pts -n 16
refused "the luminaire emits no light" irradiance room.rad --lamp dark.ies@2,2,3 --sensors desk.pts

# --- what rtrace -h -I writes
"$aureole" irradiance room.rad --sky uniform --sensors - --to rtrace -n 16 <desk.pts >rtrace.txt
"$aureole" irradiance room.rad --sky uniform --sensors desk.pts -n 16 | awk -F, 'NR > 1 { printf "%e\t%e\t%e\t\n", $4, $5, $6 }' | cmp - rtrace.txt || fail "--to rtrace"
finish
