# fish completion of yars-station. Made by scripts/completions out of --help; changes belong there.


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

complete -c yars-station -f
complete -c yars-station -s h -l help -d 'print this help'
complete -c yars-station -l version -d 'print the version'
complete -c yars-station -l session -x -a '(__yars_sessions)' -d 'session to join or create'
complete -c yars-station -l config -r -F -d 'GUF configuration file'
complete -c yars-station -l log-level -x -a 'trace debug info warning error off' -d 'lines of this level and above are logged'
complete -c yars-station -l log-dir -x -a '(__fish_complete_directories)' -d 'folder for a rotated log file'
complete -c yars-station -l realtime -d 'lock memory, run the tick loop under SCHED_FIFO; a refusal is logged'
complete -c yars-station -l cpus -x -d 'CPUs to run on, as in 2,3 or 2-3'
complete -c yars-station -l port -x -d 'port to listen at; 0: any free one'
complete -c yars-station -l listen -x -d 'address to listen at; 0.0.0.0: all'
complete -c yars-station -l names -x -d 'names of this computer in the addresses of the pages, with commas between'
complete -c yars-station -l tokens -r -F -d 'file with the tokens of instructors and viewers; made if it is not there'
complete -c yars-station -l without-tokens -d 'everybody who reaches the station is an instructor; at loopback only: every user of this computer'
complete -c yars-station -l behind-proxy -d 'believe X-Forwarded-Host, -Proto and -For; only where a proxy sets them'
complete -c yars-station -l certificate -r -F -d 'TLS certificate in PEM'
complete -c yars-station -l key -r -F -d 'private key of the certificate, in PEM'
complete -c yars-station -l without-tls -d 'listen beyond this computer without a certificate'
complete -c yars-station -l pages -x -a '(__fish_complete_directories)' -d 'folder of the pages'
complete -c yars-station -l start-script -r -F -d 'script that starts a set which flies out of a recording'
complete -c yars-station -l terrain -x -a '(__fish_complete_directories)' -d 'folder of elevation cells, for the map'
complete -c yars-station -l source -x -a '(__yars_source route:)' -d 'source of the flight; the map shows the waypoints of route:FILE'
complete -c yars-station -l recordings -x -a '(__fish_complete_directories)' -d 'folder of recordings'
