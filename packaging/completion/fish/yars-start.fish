# fish completion of yars-start. Made by scripts/completions out of --help; changes belong there.


function __yars_sessions
    string replace -f -r '^/dev/shm/yars\.'(id -u)'\.' '' /dev/shm/yars.*
end

# Words; what follows route: and the like is a file.
function __yars_source
    set -l word (commandline -ct)
    if string match -q '*:*' -- $word
        string replace -r '^' (string split -m 1 : -- $word)[1]: (__fish_complete_path (string split -m 1 : -- $word)[2])
    else
        printf '%s\n' $argv
    end
end

complete -c yars-start -f
complete -c yars-start -s h -l help -d 'print this help'
complete -c yars-start -l tour -d 'a guided tour over the generated coast, with captions; ends by itself. With pilot it waits'
complete -c yars-start -l terrain -x -a '(__fish_complete_directories)' -d 'DTED, HGT, DED, packs, rasters'
complete -c yars-start -l config -r -F -d 'GUF configuration'
complete -c yars-start -l fidelity -x -a '1996 draft standard fine reference' -d 'preset of the radar model: speed against accuracy'
complete -c yars-start -l session -x -a '(__yars_sessions)' -d 'session to make'
complete -c yars-start -l source -x -a '' -d 'the flight model\'s source'
complete -c yars-start -l headless -x -d 'no window: run so long, write frames, end'
complete -c yars-start -l frames -x -a '(__fish_complete_directories)' -d 'where frames go'
complete -c yars-start -l every -x -d 'sim time between frames'
complete -c yars-start -l no-frames -d 'without a window: no frames in files'
complete -c yars-start -l size -x -d 'edge of the picture'
complete -c yars-start -l publish -d 'the display publishes its frames in the segment, too'
complete -c yars-start -l web -d 'the display in a browser, too: prints its addresses (docs/station.md); implies --publish.'
complete -c yars-start -l web-port -x -d 'port of --web; 0 takes any free one'
complete -c yars-start -l web-listen -x -d 'address to listen at; 0.0.0.0: all'
complete -c yars-start -l web-names -x -d 'names of this computer in the addresses of the pages, with commas between'
complete -c yars-start -l web-tokens -r -F -d 'tokens of instructors and viewers; made if it is not there'
complete -c yars-start -l web-without-tokens -d 'every user of this computer may look, fly and end roles; at loopback only'
complete -c yars-start -l web-behind-proxy -d 'believe X-Forwarded-Host, -Proto and -For; only where a proxy sets them'
complete -c yars-start -l web-certificate -r -F -d 'TLS certificate in PEM'
complete -c yars-start -l web-key -r -F -d 'private key of the certificate, in PEM'
complete -c yars-start -l web-without-tls -d 'listen beyond this computer without a certificate'
complete -c yars-start -l lockstep -d 'all roles step together on sim time, as fast as they can'
complete -c yars-start -l script -r -F -d 'events for the input monitor'
complete -c yars-start -l input -x -a '(__yars_source auto evdev: terminal)' -d 'the input monitor\'s source, as evdev:PATH or auto; may be repeated'
complete -c yars-start -l no-flight -d 'attach your own flight model'
complete -c yars-start -l no-input -d 'attach your own input'
complete -c yars-start -l roles -x -d 'roles of this computer'
complete -c yars-start -l network -r -F -d 'joins other computers: GUF form Network; the gateway starts first, see docs/network.md'
complete -c yars-start -l record -r -F -d 'record ticks and events; refused when FILE is there already'
complete -c yars-start -l pictures -d 'of --record: the sweeps with their video and the patch maps, too'
complete -c yars-start -l overwrite -d 'of --record: write over FILE'
complete -c yars-start -l fly-out -r -F -d 'goes on from a recording, at the second of --at; with --record BRANCH the new recording'
complete -c yars-start -l at -x -d 'of --fly-out: sim time within the recording'
complete -c yars-start -l keep-recording -x -d 'the recording takes at most so much of the disk: the newest, in FILE.before and FILE'
complete -c yars-start -l keep-frames -x -d 'only the newest frames stay in the folder'
complete -c yars-start -l log-dir -x -a '(__fish_complete_directories)' -d 'where logs are kept, rotated; "" for none'
complete -c yars-start -l realtime -d 'locked memory and real-time priority; says what the system refuses'
complete -c yars-start -l cpus -x -d 'CPUs to run on, as in 2,3'
complete -c yars-start -l bin -x -a '(__fish_complete_directories)' -d 'programs that are built already: no set-up, no build'
