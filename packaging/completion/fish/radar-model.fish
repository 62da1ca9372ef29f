# fish completion of radar-model. Made by scripts/completions out of --help; changes belong there.


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

complete -c radar-model -f
complete -c radar-model -s h -l help -d 'print this help'
complete -c radar-model -l version -d 'print the version'
complete -c radar-model -l session -x -a '(__yars_sessions)' -d 'session to join or create'
complete -c radar-model -l config -r -F -d 'GUF configuration file'
complete -c radar-model -l log-level -x -a 'trace debug info warning error off' -d 'lines of this level and above are logged'
complete -c radar-model -l lockstep -x -d 'roles that step together on sim time, ROLE,ROLE,...[@END_TICK]; give all these roles the same value'
complete -c radar-model -l log-dir -x -a '(__fish_complete_directories)' -d 'folder for a rotated log file'
complete -c radar-model -l realtime -d 'lock memory, run the tick loop under SCHED_FIFO; a refusal is logged'
complete -c radar-model -l cpus -x -d 'CPUs to run on, as in 2,3 or 2-3'
complete -c radar-model -l terrain -x -a '(__fish_complete_directories)' -d 'folder of elevation cells: DTED, HGT, DED, packs, rasters'
complete -c radar-model -l fidelity -x -a '1996 draft standard fine reference' -d 'preset'
complete -c radar-model -l samples -x -d 'samples of a sweep'
complete -c radar-model -l standby -d 'waits while another process or another computer of the session holds the role'
