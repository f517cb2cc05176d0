#!/usr/bin/env bash
# weather.sh [LATITUDE [LONGITUDE [TIMEZONE [CLOUDS]]]] > YEAR.epw
# A year of weather that never was, in EPW: of each three days the first CLOUDS (1 unless told; 0 to 3) are overcast, and the
# others clear, in air that gets a little more turbid from day to day. For trials and tests: it claims no place on earth.
set -eu
awk -v latitude="${1:-48}" -v longitude="${2:-11}" -v zone="${3:-1}" -v clouds="${4:-1}" '
  function integer(x) { return x < 0 ? 0 : int(x + .5) }
  BEGIN {
    radian = atan2(0, -1) / 180
    printf "LOCATION,Nowhere,-,-,synthetic,000000,%.4f,%.4f,%.1f,100.0\n", latitude, longitude, zone
    print "DESIGN CONDITIONS,0"
    print "TYPICAL/EXTREME PERIODS,0"
    print "GROUND TEMPERATURES,0"
    print "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0"
    print "COMMENTS 1,made by scripts/weather.sh"
    print "COMMENTS 2,no measurements"
    print "DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31"
    split("31 28 31 30 31 30 31 31 30 31 30 31", lengths, " ")
    for (month = 1; month <= 12; ++month)
      for (day = 1; day <= lengths[month]; ++day) {
        ++number
        # Cooper (1969) and Spencer (1971): good enough for a sky that nobody saw.
        declination = 23.45 * sin(360 / 365 * (284 + number) * radian) * radian
        b = 360 / 365 * (number - 81) * radian
        shift = (9.87 * sin(2 * b) - 7.53 * cos(b) - 1.5 * sin(b)) / 60 + longitude / 15 - zone
        for (hour = 1; hour <= 24; ++hour) {
          angle = 15 * (hour - .5 + shift - 12) * radian
          height = sin(latitude * radian) * sin(declination) + cos(latitude * radian) * cos(declination) * cos(angle)
          direct = diffuse = 0
          if (height > .02 && number % 3 < clouds) {
            diffuse = 250 * height
          } else if (height > .02) {
            direct = 1050 * exp(-(.16 + .00015 * number) / height)
            diffuse = 30 + 80 * height
          }
          printf "2001,%d,%d,%d,60,synthetic,10.0,6.0,75,100000,9999,9999,300,%d,%d,%d,999999,999999,999999,9999,", month,
            day, hour, integer(direct * height + diffuse), integer(direct), integer(diffuse)
          print "180,2.0,5,5,20.0,77777,9,999999999,15,0.1,0,88,0.2,0.0,1.0"
        }
      }
  }'
